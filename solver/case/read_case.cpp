// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/case/read_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/base/error.hpp"
#include "common/toml/input_file.hpp"
#include "common/toml/recognise_input.hpp"
#include "common/toml/toml_text.hpp"
#include "solver/case/case_schema.hpp"
#include "solver/case/check_case.hpp"

namespace ice {

namespace {

// Puts values, defaults and complaints about missing keys together.
class Builder {
public:
    Builder(const std::filesystem::path& file, Values values, std::size_t groups,
            Mistakes& mistakes)
        : values_(std::move(values)),
          groups_(groups),
          mistakes_(mistakes),
          complaints_{file, mistakes} {
        case_.file = file;
    }

    Case build() {
        // The choice among exclusive keys comes first: it decides which keys are missing, and
        // some defaults.
        check_choices();
        case_.floes.resize(groups_);
        std::string table;
        const auto& keys = case_keys();
        for (std::size_t k = 0; k < keys.size();) {
            // all keys of [[floes]] at once, for each group in turn
            if (keys[k].path.starts_with("floes.")) {
                k = build_floes(k);
                continue;
            }
            FloeGroup unused;
            open_table(keys[k], table);
            take(keys[k], std::string(keys[k].path), unused);
            ++k;
        }
        // rules between keys would mislead where one of them is already wrong
        if (mistakes_.texts.empty()) check_case(case_, groups_, values_, complaints_);
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
    void open_table(const Key& key, std::string& table) {
        const auto dot = key.path.rfind('.');
        const std::string now(dot == std::string_view::npos ? "" : key.path.substr(0, dot));
        if (now == table) return;
        case_.resolved += "\n[" + now + "]\n";
        table = now;
    }

    // Keys of [[floes]] are adjacent in the schema. @return the first key behind them
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
        // Not given: "-" stays away, a mistake was named already, "" is required, all else has
        // a default.
        auto given = values_.find(label);
        if (given == values_.end() && key.default_text == "-") return;
        if (given == values_.end() && mistakes_.bad_keys.contains(label)) return;
        if (given == values_.end() && key.default_text.empty()) {
            complaints_.add(
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
        // paths are relative to the case, not to where the program was started
        if (path.is_relative())
            path = std::filesystem::absolute(complaints_.file).parent_path() / path;
        path = path.lexically_normal();
        if (!std::filesystem::exists(path))
            complaints_.add_at(
                label, fmt::format("{}: file {} not found; make it with {}",
                                   counted_from_one(label), path.string(), maker_of(path, label)));
        else if (const std::string other = other_kind(path, label); !other.empty())
            complaints_.add_at(
                label, fmt::format("{}: {} is {}", counted_from_one(label), path.string(), other));
        return path.string();
    }

    // the kind of file given in place of a sphere set or a field, and the remedy; "": may be one
    static std::string other_kind(const std::filesystem::path& path, const std::string& label) {
        if (std::filesystem::is_directory(path)) return "a folder; name a file in it";
        if (label == "ship.matrix") return "";  // a text, checked as it is read
        if (path.extension() == ".toml" || path.extension() == ".cfg")
            return "a text; a specification becomes a field with icefield";
        const auto mesh = recognise_file(path, "");
        return mesh ? fmt::format("{}; spherize {} makes a sphere set of it", mesh->what,
                                  path.string())
                    : "";
    }

    // what the message proposes, by the key that names the file
    // a shipped case brings the list of commands that make its files
    static std::string maker_of(const std::filesystem::path& missing, const std::string& label) {
        const auto folder = missing.parent_path();
        if (std::filesystem::exists(folder / "spheres.txt"))
            return fmt::format("cases/prepare.sh {}", folder.string());
        if (label == "flow.file") return "iceflow";
        if (label == "ship.matrix") return "examples/ship_matrix.py";
        return label.ends_with(".file") ? "icefield" : "spherize";
    }

    // The hull's height comes from its draught or from z.
    void check_hull_place() {
        if (mistakes_.bad_keys.contains("hull.position")) return;
        const bool draught = values_.contains("hull.draught");
        const auto position = values_.find("hull.position");
        if (position == values_.end()) {
            // no place, but a draught: the mesh's origin lies at x = y = 0
            if (draught) values_["hull.position"] = std::vector<double>{0.0, 0.0};
            return;
        }
        // two numbers leave the height to the draught, three give it
        const bool has_z = std::get<std::vector<double>>(position->second).size() == 3;
        if (has_z && draught)
            complaints_.add_at(
                "hull.draught",
                "hull.draught and the z of hull.position both say how deep the hull lies; "
                "write hull.position = [x, y], or leave hull.draught out");
        if (!has_z && !draught && !mistakes_.bad_keys.contains("hull.draught"))
            complaints_.add_at(
                "hull.position",
                "hull.position has no z; add hull.draught, or the z of the mesh's origin");
    }

    void check_choices() {
        check_hull_place();
        // the paper's 2D ice is rigid; a value that was given stays (try_emplace)
        if (const auto dimension = values_.find("simulation.dimension");
            dimension != values_.end() && std::get<std::int64_t>(dimension->second) == 2)
            values_.try_emplace("contact.crushing_pressure",
                                std::numeric_limits<double>::infinity());
        const bool speed = values_.contains("hull.speed");
        const bool table = values_.contains("hull.speed_table");
        const bool bad = mistakes_.bad_keys.contains("hull.speed") ||
                         mistakes_.bad_keys.contains("hull.speed_table");
        if (speed == table && !bad)
            complaints_.add(speed ? "hull.speed and hull.speed_table are both given; keep one"
                                  : "required key 'hull.speed' (or hull.speed_table) is missing");
        check_flow();
        for (std::size_t g = 0; g < groups_; ++g) check_source(g);
        if (groups_ == 0)
            check_level_ice();
        else
            check_sheet_keys();
        set_sheet_spacing();
        // the first third, in which the ship enters the ice, is left out
        if (!values_.contains("output.average_from") && values_.contains("simulation.duration"))
            values_["output.average_from"] = std::get<double>(values_["simulation.duration"]) / 3.0;
    }

    // Without floes a run needs a sheet of some thickness, whose default is none.
    void check_level_ice() {
        const std::string thickness = "level_ice.thickness";
        const auto of_sheet = [](const std::string& label) {
            return label.starts_with("level_ice.");
        };
        // a value that could not be read is reported already
        if (mistakes_.bad_keys.contains(thickness)) return;
        const auto given = values_.find(thickness);
        if (given != values_.end()) {
            if (std::get<double>(given->second) == 0.0)
                complaints_.add_at(thickness,
                                   "level_ice.thickness = 0: a case with [level_ice] and without "
                                   "[[floes]] needs a thickness above 0");
        } else if (std::any_of(values_.begin(), values_.end(),
                               [&](const auto& value) { return of_sheet(value.first); }) ||
                   std::any_of(mistakes_.bad_keys.begin(), mistakes_.bad_keys.end(), of_sheet)) {
            complaints_.add(
                "required key 'level_ice.thickness' is missing: a case with [level_ice] and "
                "without [[floes]] needs a thickness above 0");
        } else {
            complaints_.add(
                "no [[floes]] table and no [level_ice]: a run needs at least one group of floes");
        }
    }

    // Spheres as far apart as the sheet's thickness allows, in whole nanometres, which the resolved
    // case prints with few digits.
    void set_sheet_spacing() {
        const std::string spacing = "level_ice.spacing";
        const auto thickness = values_.find("level_ice.thickness");
        if (thickness == values_.end() || mistakes_.bad_keys.contains(spacing)) return;
        if (const double h = std::get<double>(thickness->second); h > 0.0)
            values_.try_emplace(spacing, std::round(1e9 * kLevelIceSpacing * h) / 1e9);
    }

    // Beside floes a sheet is a choice, and its keys mean nothing without one.
    void check_sheet_keys() {
        const std::string thickness = "level_ice.thickness";
        if (values_.contains(thickness) || mistakes_.bad_keys.contains(thickness)) return;
        const auto key = std::find_if(values_.begin(), values_.end(), [](const auto& value) {
            return value.first.starts_with("level_ice.");
        });
        if (key != values_.end())
            complaints_.add_at(key->first, key->first +
                                               " is given, but there is no sheet: give "
                                               "level_ice.thickness, or leave [level_ice] out");
    }

    // The flow comes from a file with model "file" alone.
    void check_flow() {
        if (mistakes_.bad_keys.contains("flow.model") || mistakes_.bad_keys.contains("flow.file"))
            return;
        const auto model = values_.find("flow.model");
        const bool from_file =
            model != values_.end() && std::get<std::string>(model->second) == "file";
        if (from_file && !values_.contains("flow.file"))
            complaints_.add_at("flow.model",
                               "flow.model = \"file\" needs flow.file, made by iceflow");
        if (!from_file && values_.contains("flow.file"))
            complaints_.add_at("flow.file",
                               "flow.file is given, but only flow.model = \"file\" takes it");
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
        // floes of a field are afloat and loose unless the case says otherwise
        if (field && !given("hold")) values_[label("hold")] = std::string("never");
        const char* const needed = field ? "file" : "spheres";
        const char* const other = field ? "spheres" : "file";
        if (!given(needed))
            complaints_.add(fmt::format("required key '{}' is missing ({})",
                                        counted_from_one(label(needed)),
                                        case_schema().find(fmt::format("floes.{}", needed))->doc));
        if (given(other))
            complaints_.add_at(
                label(other),
                fmt::format("floes.{}.{} is given, but pattern \"file\" {}", g + 1, other,
                            field ? "takes its shapes from the field" : "alone takes it"));
    }

    Values values_;
    std::size_t groups_;
    Mistakes& mistakes_;
    Complaints complaints_;
    Case case_;
};

// "floes.gap" of an override applies to every group, with its place for complaints
void spread_to_groups(Values& values, std::size_t groups, Mistakes& mistakes) {
    for (const CaseKey& key : case_keys()) {
        const std::string path(key.path);
        const auto found = values.find(path);
        if (!path.starts_with("floes.") || found == values.end()) continue;
        const std::string place = mistakes.places.at(path);
        for (std::size_t g = 0; g < groups; ++g) {
            const std::string label =
                fmt::format("floes.{}.{}", g, path.substr(sizeof("floes.") - 1));
            values[label] = found->second;
            mistakes.places[label] = place;
        }
        values.erase(found);
    }
}

// a thrust of one kind replaces those of the others
void replace_propulsion(const Values& given, Values& values) {
    const std::vector<std::string> kinds{"propulsion.thrust", "propulsion.thrust_table",
                                         "propulsion.bollard_pull", "propulsion.power",
                                         "propulsion.hold_speed"};
    if (std::any_of(kinds.begin(), kinds.end(),
                    [&](const std::string& kind) { return given.contains(kind); }))
        for (const std::string& kind : kinds) values.erase(kind);
}

Case read_once(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
    Mistakes mistakes;
    std::size_t groups = 0;
    Values values = read_toml(read_input_text(file, "case file", ".cfg"), file.string(),
                              case_schema(), mistakes, groups);
    // with a syntax error the rest of the file was not seen: missing keys would mislead
    const bool unreadable = !mistakes.texts.empty() && values.empty();
    for (const std::string& text : overrides) {
        Values given = read_override(text, case_schema(), groups, mistakes);
        spread_to_groups(given, groups, mistakes);
        // a speed replaces a table and the other way round
        if (given.contains("hull.speed")) values.erase("hull.speed_table");
        if (given.contains("hull.speed_table")) values.erase("hull.speed");
        replace_propulsion(given, values);
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
    throw_mistakes(mistakes, file, "icesolve --explain KEY explains a key");
    return result;
}

}  // namespace

Case read_case(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
    // First in a child process, which may crash or run out of memory on a strange file; then
    // here.
    rehearse_input(file, [&] { read_once(file, overrides); });
    return read_once(file, overrides);
}

}  // namespace ice
