// SPDX-License-Identifier: GPL-3.0-or-later
// From the text of a specification to a FieldSpec: keys are read by the schema, then checked
// against the pattern and against each other, and completed.
#include <fmt/format.h>

#include <algorithm>

#include "common/base/error.hpp"
#include "common/toml/input_file.hpp"
#include "preprocess/field/field_schema.hpp"

namespace ice {

namespace {

// Puts values and defaults together and complains about keys that do not fit.
class SpecBuilder {
public:
    SpecBuilder(const std::filesystem::path& file, Values values, Mistakes& mistakes)
        : file_(file), values_(std::move(values)), mistakes_(mistakes) {}

    FieldSpec build() {
        FieldSpec spec;
        for (const FieldKey& key : field_keys()) take(key, spec);
        if (values_.contains("pattern")) check_pattern();
        if (mistakes_.texts.empty()) complete(spec);
        return spec;
    }

private:
    void complain_at(std::string_view key, const std::string& what) {
        const auto place = mistakes_.places.find(std::string(key));
        mistakes_.add((place == mistakes_.places.end() ? file_.string() : place->second) +
                      ": error: " + what);
    }

    bool given(std::string_view key) const {
        return values_.contains(std::string(key)) || mistakes_.bad_keys.contains(std::string(key));
    }

    void missing(std::string_view key, const std::string& who) {
        mistakes_.add(fmt::format("{}: error: required key '{}' is missing{} ({})", file_.string(),
                                  key, who, field_schema().find(key)->doc));
    }

    void take(const FieldKey& key, FieldSpec& spec) {
        // A key that was given but is faulty has a message already; "-" is no default but "not
        // given", and no default at all means required.
        const auto found = values_.find(std::string(key.path));
        if (found == values_.end() && given(key.path)) return;
        if (found == values_.end() && key.default_text == "-") return;
        if (found == values_.end() && key.default_text.empty()) return missing(key.path, "");
        Value value = found == values_.end() ? default_value(key, field_schema()) : found->second;
        if (key.kind == Kind::path) {
            std::filesystem::path path = std::get<std::string>(value);
            if (path.is_relative()) path = std::filesystem::absolute(file_).parent_path() / path;
            value = path.lexically_normal().string();
            if (!std::filesystem::is_regular_file(std::get<std::string>(value)))
                complain_at(key.path, fmt::format("{}: file {} not found", key.path,
                                                  std::get<std::string>(value)));
        }
        key.store(spec, value);
    }

    void check_pattern() {
        // Keys of other patterns are refused, not ignored: a size that has no effect would mislead.
        const auto& name = std::get<std::string>(values_["pattern"]);
        const auto& all = pattern_keys();
        const auto mine = std::find_if(all.begin(), all.end(),
                                       [&](const PatternKeys& p) { return p.name == name; });
        const auto lists = [](const PatternKeys& p, std::string_view key) {
            return std::count(p.required.begin(), p.required.end(), key) +
                       std::count(p.optional.begin(), p.optional.end(), key) >
                   0;
        };
        for (const std::string_view key : mine->required)
            if (!given(key)) missing(key, fmt::format(" for pattern \"{}\"", name));
        for (const auto& entry : values_) {
            const std::string& key = entry.first;
            const bool others = std::any_of(all.begin(), all.end(),
                                            [&](const PatternKeys& p) { return lists(p, key); });
            if (others && !lists(*mine, key))
                complain_at(key, fmt::format("{} means nothing to pattern \"{}\"", key, name));
        }
    }

    // Defaults that follow from other keys, and conditions between keys.
    void complete(FieldSpec& s) {
        // a radius of a quarter of the thickness gives two layers of spheres
        if (!given("spheres.radius")) s.radius = 0.25 * s.thickness;
        if (!given("spheres.spacing")) s.spacing = 2.0 * s.radius;
        if (!given("floes.breaking_depth")) s.breaking_depth = 0.5 * s.breaking_length;
        if (!given("edges.piece")) s.edge_piece = 4.0 * s.edge_breadth;
        if (!given("edges.ahead")) s.edge_ahead = s.edge_breadth;
        if (s.edge_ahead > 0.0 && s.edge_breadth == 0.0)
            complain_at("edges.ahead",
                        "edges.ahead closes a channel, but edges.breadth is 0: there "
                        "are no sides; state edges.breadth as well");
        if (!(2.0 * s.radius < s.thickness))
            complain_at("spheres.radius",
                        fmt::format("spheres.radius {:g} m does not fit into ice of {:g} m; use "
                                    "less than half",
                                    s.radius, s.thickness));
        if (!(2.0 * s.chamfer < s.thickness))
            complain_at("ice.chamfer",
                        "ice.chamfer leaves nothing of the side; use less than half "
                        "the thickness");
        if (s.pattern == FieldPattern::power_law && !(s.smallest < s.largest))
            complain_at("floes.smallest", "floes.smallest is not below floes.largest");
        if (s.pattern == FieldPattern::cusps) check_cusps(s);
    }

    void check_cusps(const FieldSpec& s) {
        if (!(s.breaking_depth < s.breaking_length))
            complain_at("floes.breaking_depth",
                        "floes.breaking_depth is not below floes.breaking_length: cusps of one row "
                        "would reach into those of the next");
        if (s.breaking_depth > 0.5 * s.breaking_width)
            complain_at("floes.breaking_depth",
                        "floes.breaking_depth is more than half floes.breaking_width: no arc of a "
                        "circle goes so far beyond its chord");
    }

    std::filesystem::path file_;
    Values values_;
    Mistakes& mistakes_;
};

FieldSpec read_once(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
    Mistakes mistakes;
    std::size_t unused = 0;
    std::string text = read_input_text(file, "field specification", ".toml");
    Values values = read_toml(text, file.string(), field_schema(), mistakes, unused);
    // with a syntax error the rest of the file was not seen: missing keys would mislead
    const bool unreadable = !mistakes.texts.empty() && values.empty();
    for (const std::string& given : overrides) {
        for (auto& [key, value] : read_override(given, field_schema(), 0, mistakes))
            values[key] = value;
        text += fmt::format("# --set {}\n", given);
    }
    FieldSpec spec;
    if (!unreadable) spec = SpecBuilder(file, std::move(values), mistakes).build();
    throw_mistakes(mistakes, file, "icefield --explain KEY explains a key");
    spec.text = text;
    return spec;
}

}  // namespace

FieldSpec read_field_spec(const std::filesystem::path& file,
                          const std::vector<std::string>& overrides) {
    rehearse_input(file, [&] { read_once(file, overrides); });
    return read_once(file, overrides);
}

}  // namespace ice
