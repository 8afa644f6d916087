// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/case/read_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "common/base/error.hpp"
#include "common/toml/input_file.hpp"
#include "common/toml/recognise_input.hpp"
#include "solver/case/case_schema.hpp"

namespace ice {

namespace {

constexpr double kMostSteps = 1e8;

std::string toml_text(const Value& value, const Key& key) {
    struct Writer {
        const Key& key;
        std::string operator()(double v) const {
            const std::string text = fmt::format("{}", v);
            // TOML floats need a point, an exponent or a name (inf)
            return text.find_first_of(".einf") == std::string::npos ? text + ".0" : text;
        }
        std::string operator()(std::int64_t v) const { return fmt::format("{}", v); }
        std::string operator()(const std::string& v) const {
            std::string out = "\"";
            for (const char c : v) {
                // TOML allows no bare control characters
                if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
                    out += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
                    continue;
                }
                if (c == '"' || c == '\\') out += '\\';
                out += c;
            }
            return out + "\"";
        }
        std::string operator()(const std::vector<double>& v) const {
            const bool whole = key.kind == Kind::integer_list || key.kind == Kind::counts;
            std::string out = "[";
            for (const double x : v)
                out += (out.size() > 1 ? ", " : "") +
                       (whole ? fmt::format("{}", static_cast<std::int64_t>(x)) : (*this)(x));
            return out + "]";
        }
        std::string operator()(const std::vector<std::pair<double, double>>& v) const {
            std::string out = "[";
            for (const auto& [t, u] : v)
                out +=
                    fmt::format("{}[{}, {}]", out.size() > 1 ? ", " : "", (*this)(t), (*this)(u));
            return out + "]";
        }
    };
    return std::visit(Writer{key}, value);
}

// Puts values, defaults and complaints about missing keys together.
class Builder {
public:
    Builder(const std::filesystem::path& file, Values values, std::size_t groups,
            Mistakes& mistakes)
        : file_(file), values_(std::move(values)), groups_(groups), mistakes_(mistakes) {
        case_.file = file;
    }

    Case build() {
        check_choices();
        case_.floes.resize(groups_);
        std::string table;
        const auto& keys = case_keys();
        for (std::size_t k = 0; k < keys.size();) {
            if (keys[k].path.starts_with("floes.")) {
                k = build_floes(k);
                continue;
            }
            FloeGroup unused;
            open_table(keys[k], table);
            take(keys[k], std::string(keys[k].path), unused);
            ++k;
        }
        if (mistakes_.texts.empty()) check_case();
        // unbroken ice of fields: groups of their own, behind the case's, which keep their numbers
        for (std::size_t g = 0; g < groups_; ++g) {
            if (case_.floes[g].pattern != Pattern::file) continue;
            FloeGroup unbroken = case_.floes[g];
            unbroken.unbroken_part = true;
            unbroken.hold = Hold::always;
            case_.floes.push_back(unbroken);
        }
        return case_;
    }

private:
    void complain(const std::string& what) { mistakes_.add(file_.string() + ": error: " + what); }

    // ... about a key that was given, at its place
    void complain_at(const std::string& label, const std::string& what) {
        const auto place = mistakes_.places.find(label);
        mistakes_.add((place == mistakes_.places.end() ? file_.string() : place->second) +
                      ": error: " + what);
    }

    // "floes.0.gap" as people count: floes.1.gap
    static std::string counted_from_one(const std::string& label) {
        if (!label.starts_with("floes.")) return label;
        const auto dot = label.find('.', sizeof("floes.") - 1);
        return fmt::format("floes.{}{}", std::atol(label.c_str() + sizeof("floes.") - 1) + 1,
                           label.substr(dot));
    }

    void open_table(const Key& key, std::string& table) {
        const auto dot = key.path.rfind('.');
        const std::string now(dot == std::string_view::npos ? "" : key.path.substr(0, dot));
        if (now == table) return;
        case_.resolved += "\n[" + now + "]\n";
        table = now;
    }

    std::size_t build_floes(std::size_t first) {
        const auto& keys = case_keys();
        std::size_t end = first;
        while (end < keys.size() && keys[end].path.starts_with("floes.")) ++end;
        for (std::size_t g = 0; g < groups_; ++g) {
            case_.resolved += "\n[[floes]]\n";
            for (std::size_t k = first; k < end; ++k)
                take(keys[k],
                     fmt::format("floes.{}.{}", g, keys[k].path.substr(sizeof("floes.") - 1)),
                     case_.floes[g]);
        }
        return end;
    }

    // stores the given value of a key, or its default
    void take(const CaseKey& key, const std::string& label, FloeGroup& group) {
        auto given = values_.find(label);
        if (given == values_.end() && key.default_text == "-") return;
        if (given == values_.end() && mistakes_.bad_keys.contains(label)) return;
        if (given == values_.end() && key.default_text.empty()) {
            complain(
                fmt::format("required key '{}' is missing ({})", counted_from_one(label), key.doc));
            return;
        }
        if (given == values_.end())
            given = values_.emplace(label, default_value(key, case_schema())).first;
        if (key.kind == Kind::path) given->second = resolve_path(label, given->second);
        key.store(case_, group, given->second);
        case_.resolved += fmt::format("{} = {}\n", key.path.substr(key.path.rfind('.') + 1),
                                      toml_text(given->second, key));
    }

    Value resolve_path(const std::string& label, const Value& value) {
        std::filesystem::path path = std::get<std::string>(value);
        if (path.is_relative()) path = std::filesystem::absolute(file_).parent_path() / path;
        path = path.lexically_normal();
        if (!std::filesystem::exists(path))
            complain_at(label,
                        fmt::format("{}: file {} not found; make it with {}",
                                    counted_from_one(label), path.string(), maker_of(path, label)));
        else if (const std::string other = other_kind(path); !other.empty())
            complain_at(label,
                        fmt::format("{}: {} is {}", counted_from_one(label), path.string(), other));
        return path.string();
    }

    // what was given in place of a sphere set or a field, and what to do; "" where it may be one
    static std::string other_kind(const std::filesystem::path& path) {
        if (std::filesystem::is_directory(path)) return "a folder; name a file in it";
        if (path.extension() == ".toml" || path.extension() == ".cfg")
            return "a text; a specification becomes a field with icefield";
        const auto mesh = recognise_file(path, "");
        return mesh ? fmt::format("{}; spherize {} makes a sphere set of it", mesh->what,
                                  path.string())
                    : "";
    }

    // a shipped case brings the list of what makes its files
    static std::string maker_of(const std::filesystem::path& missing, const std::string& label) {
        const auto folder = missing.parent_path();
        if (std::filesystem::exists(folder / "spheres.txt"))
            return fmt::format("cases/prepare.sh {}", folder.string());
        return label.ends_with(".file") ? "icefield" : "spherize";
    }

    // The hull's height comes from its draught or from z.
    void check_hull_place() {
        if (mistakes_.bad_keys.contains("hull.position")) return;
        const bool draught = values_.contains("hull.draught");
        const auto position = values_.find("hull.position");
        if (position == values_.end()) {
            if (draught) values_["hull.position"] = std::vector<double>{0.0, 0.0};
            return;
        }
        const bool has_z = std::get<std::vector<double>>(position->second).size() == 3;
        if (has_z && draught)
            complain_at("hull.draught",
                        "hull.draught and the z of hull.position both say how deep the hull lies; "
                        "write hull.position = [x, y], or leave hull.draught out");
        if (!has_z && !draught && !mistakes_.bad_keys.contains("hull.draught"))
            complain_at("hull.position",
                        "hull.position has no z; add hull.draught, or the z of the mesh's origin");
    }

    void check_choices() {
        check_hull_place();
        if (const auto dimension = values_.find("simulation.dimension");
            dimension != values_.end() && std::get<std::int64_t>(dimension->second) == 2)
            values_.try_emplace("contact.crushing_pressure",
                                std::numeric_limits<double>::infinity());
        const bool speed = values_.contains("hull.speed");
        const bool table = values_.contains("hull.speed_table");
        const bool bad = mistakes_.bad_keys.contains("hull.speed") ||
                         mistakes_.bad_keys.contains("hull.speed_table");
        if (speed == table && !bad)
            complain(speed ? "hull.speed and hull.speed_table are both given; keep one"
                           : "required key 'hull.speed' (or hull.speed_table) is missing");
        for (std::size_t g = 0; g < groups_; ++g) check_source(g);
        if (groups_ == 0) complain("no [[floes]] table: a run needs at least one group of floes");
        if (!values_.contains("output.average_from") && values_.contains("simulation.duration"))
            values_["output.average_from"] = std::get<double>(values_["simulation.duration"]) / 3.0;
    }

    // Floes come from a sphere set, or with pattern "file" from a field.
    void check_source(std::size_t g) {
        const auto label = [&](const char* key) { return fmt::format("floes.{}.{}", g, key); };
        const auto given = [&](const char* key) {
            return values_.contains(label(key)) || mistakes_.bad_keys.contains(label(key));
        };
        if (mistakes_.bad_keys.contains(label("pattern"))) return;
        const auto pattern = values_.find(label("pattern"));
        const bool field =
            pattern != values_.end() && std::get<std::string>(pattern->second) == "file";
        if (field && !given("hold")) values_[label("hold")] = std::string("never");
        const char* const needed = field ? "file" : "spheres";
        const char* const other = field ? "spheres" : "file";
        if (!given(needed))
            complain(fmt::format("required key '{}' is missing ({})",
                                 counted_from_one(label(needed)),
                                 case_schema().find(fmt::format("floes.{}", needed))->doc));
        if (given(other))
            complain_at(label(other),
                        fmt::format("floes.{}.{} is given, but pattern \"file\" {}", g + 1, other,
                                    field ? "takes its shapes from the field" : "alone takes it"));
    }

    void check_case() {
        for (std::size_t g = 0; g < groups_; ++g) check_group(g);
        if (case_.average_from >= case_.duration)
            complain_at("output.average_from",
                        "output.average_from is not before the end (simulation.duration)");
        if (case_.time_step > case_.duration)
            complain_at("simulation.time_step",
                        "simulation.time_step is longer than simulation.duration");
        if (case_.duration / case_.time_step > kMostSteps)
            complain_at("simulation.time_step",
                        fmt::format("simulation.duration / time_step asks for more than {:g} steps",
                                    kMostSteps));
        std::vector<int> track = case_.track;
        std::sort(track.begin(), track.end());
        const auto twice = std::adjacent_find(track.begin(), track.end());
        if (twice != track.end())
            complain_at("output.track", fmt::format("output.track names floe {} twice", *twice));
    }

    void check_group(std::size_t g) {
        FloeGroup& group = case_.floes[g];
        const auto label = [&](const char* key) { return fmt::format("floes.{}.{}", g, key); };
        const auto wrong = [&](const char* key, const std::string& what) {
            complain_at(label(key), fmt::format("floes.{}.{} {}", g + 1, key, what));
        };
        if (group.pattern == Pattern::file && case_.dimension == 2)
            wrong("pattern", "= \"file\" is for cases of dimension 3");
        if (group.pattern == Pattern::single && !values_.contains(label("position")))
            wrong("position", "is missing: pattern \"single\" needs it");
        if (group.orientation.norm() < 1e-6)
            wrong("orientation", "is zero");
        else
            group.orientation.normalize();
        const bool moves = !group.velocity.isZero(0.0) || !group.angular_velocity.isZero(0.0);
        if (moves && group.hold != Hold::never)
            wrong("velocity", "is given, but a held floe does not move; set hold = \"never\"");
        if (case_.dimension == 2) check_plane(group, wrong);
    }

    // 2D is motion in the plane y = 0: nothing may lean or move out of it
    template <class Wrong>
    static void check_plane(const FloeGroup& group, const Wrong& wrong) {
        const std::string out = "leaves the plane y = 0 of a 2D case";
        if (group.count[1] != 1) wrong("count", "has more than one row along y in a 2D case");
        if (group.position.y() != 0.0) wrong("position", out);
        if (group.velocity.y() != 0.0) wrong("velocity", out);
        if (group.orientation.x() != 0.0 || group.orientation.z() != 0.0) wrong("orientation", out);
        if (group.angular_velocity.x() != 0.0 || group.angular_velocity.z() != 0.0)
            wrong("angular_velocity", out);
    }

    std::filesystem::path file_;
    Values values_;
    std::size_t groups_;
    Mistakes& mistakes_;
    Case case_;
};

// "floes.gap" of an override goes to every group
void spread_to_groups(Values& values, std::size_t groups) {
    for (const CaseKey& key : case_keys()) {
        const auto found = values.find(std::string(key.path));
        if (!key.path.starts_with("floes.") || found == values.end()) continue;
        for (std::size_t g = 0; g < groups; ++g)
            values[fmt::format("floes.{}.{}", g, key.path.substr(sizeof("floes.") - 1))] =
                found->second;
        values.erase(found);
    }
}

}  // namespace

double Case::ship_speed(double time) const {
    if (time <= speed_table.front().first) return speed_table.front().second;
    if (time > speed_table.back().first) return speed_table.back().second;
    const auto after = std::lower_bound(speed_table.begin(), speed_table.end(), time,
                                        [](const auto& row, double t) { return row.first < t; });
    const auto& [t0, u0] = *(after - 1);
    const auto& [t1, u1] = *after;
    return u0 + (u1 - u0) * (time - t0) / (t1 - t0);
}

double Case::ship_travel(double from, double to) const {
    double sum = 0.0, before = from;
    const auto go_to = [&](double time) {  // the speed is linear up to there
        sum += 0.5 * (time - before) * (ship_speed(before) + ship_speed(time));
        before = time;
    };
    for (const auto& row : speed_table)
        if (row.first > before && row.first < to) go_to(row.first);
    go_to(to);
    return sum;
}

namespace {

Case read_once(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
    Mistakes mistakes;
    std::size_t groups = 0;
    Values values = read_toml(read_input_text(file, "case file", ".cfg"), file.string(),
                              case_schema(), mistakes, groups);
    // with a syntax error the rest of the file was not seen: missing keys would mislead
    const bool unreadable = !mistakes.texts.empty() && values.empty();
    for (const std::string& text : overrides) {
        Values given = read_override(text, case_schema(), groups, mistakes);
        spread_to_groups(given, groups);
        // a speed replaces a table and the other way round
        if (given.contains("hull.speed")) values.erase("hull.speed_table");
        if (given.contains("hull.speed_table")) values.erase("hull.speed");
        // so does a draught a height
        const auto position = values.find("hull.position");
        if (given.contains("hull.draught") && position != values.end())
            std::get<std::vector<double>>(position->second).resize(2);
        if (const auto place = given.find("hull.position");
            place != given.end() && std::get<std::vector<double>>(place->second).size() == 3)
            values.erase("hull.draught");
        for (auto& [label, value] : given) values[label] = value;
    }
    Case result;
    if (!unreadable) result = Builder(file, std::move(values), groups, mistakes).build();
    throw_mistakes(mistakes, file, "icesolve --explain KEY tells what a key takes");
    return result;
}

}  // namespace

Case read_case(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
    rehearse_input(file, [&] { read_once(file, overrides); });
    return read_once(file, overrides);
}

}  // namespace ice
