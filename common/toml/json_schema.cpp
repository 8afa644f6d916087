// SPDX-License-Identifier: GPL-3.0-or-later
// The schema table as JSON schema: editors complete, explain and underline by it.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "common/toml/read_toml.hpp"
#include "common/toml/schema.hpp"

namespace ice {

namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> split(std::string_view text, std::string_view separator) {
    std::vector<std::string> parts;
    for (std::size_t begin = 0; !text.empty() && begin <= text.size();) {
        const std::size_t end = std::min(text.find(separator, begin), text.size());
        parts.emplace_back(text.substr(begin, end - begin));
        begin = end + separator.size();
    }
    return parts;
}

// Texts as parse_quantity reads them, in ECMA's dialect: an editor refuses "2 kg" as a speed.
std::string quantity_pattern(Dimension dimension, bool infinite) {
    constexpr const char* kNumber = "([0-9]+[.]?[0-9]*|[.][0-9]+)([eE][+-]?[0-9]+)?";
    std::string units;
    for (const std::string& unit : split(unit_names(dimension), ", "))
        units += (units.empty() ? "" : "|") + unit;
    if (!units.empty()) units = fmt::format("([ \\t]*({}))?", units);
    return fmt::format("^[ \\t]*[+]?-?({}{}){}[ \\t]*$", kNumber, infinite ? "|inf" : "", units);
}

// A number in SI or a text with a unit. JSON has no infinity: taplo hands `inf` on as null.
Json quantity(const Key& key, Dimension dimension) {
    const bool infinite = std::isinf(key.high) || std::isinf(key.low);
    Json out;
    out["type"] = {"number", "string"};
    if (infinite) out["type"].push_back("null");
    if (std::isfinite(key.low)) out["minimum"] = key.low;
    if (std::isfinite(key.high)) out["maximum"] = key.high;
    out["pattern"] = quantity_pattern(dimension, infinite);
    return out;
}

Json whole_number(const Key& key) {
    return {{"type", "integer"},
            {"minimum", static_cast<std::int64_t>(key.low)},
            {"maximum", static_cast<std::int64_t>(key.high)}};
}

Json list(const Json& items, std::size_t least, std::size_t most) {
    return {{"type", "array"}, {"items", items}, {"minItems", least}, {"maxItems", most}};
}

Json value_schema(const Key& key) {
    switch (key.kind) {
        case Kind::number:
            return quantity(key, key.dimension);
        case Kind::integer:
            return whole_number(key);
        case Kind::boolean:
            return {{"type", "boolean"}};
        case Kind::text:
        case Kind::path:
            return {{"type", "string"}};
        case Kind::choice:
            return {{"enum", split(key.choices, "|")}};
        case Kind::vector:
            return list(quantity(key, key.dimension), key.length, key.length);
        case Kind::counts:
            return list(whole_number(key), key.length, key.length);
        // x and y, with z or without it (floating equilibrium).
        case Kind::place:
            return list(quantity(key, key.dimension), key.length - 1, key.length);
        case Kind::integer_list:
            return {{"type", "array"}, {"items", whole_number(key)}};
        // Rows [time, value], at least one.
        case Kind::pair_list: {
            Json row = list(
                Json::array({quantity(key, Dimension::time), quantity(key, key.dimension)}), 2, 2);
            return {{"type", "array"}, {"items", row}, {"minItems", 1}};
        }
        // Rows [speed, value], at least one.
        case Kind::curve: {
            Json row = list(
                Json::array({quantity(key, Dimension::speed), quantity(key, key.dimension)}), 2, 2);
            return {{"type", "array"}, {"items", row}, {"minItems", 1}};
        }
        case Kind::words:
            return {{"type", "array"},
                    {"items", {{"enum", split(key.choices, "|")}}},
                    {"uniqueItems", true}};
        case Kind::choice_or_vector:
            return {{"anyOf",
                     {{{"enum", split(key.choices, "|")}},
                      list(quantity(key, key.dimension), key.length, key.length)}}};
    }
    return Json::object();
}

// The default as JSON; null where JSON has no such value (inf).
Json default_json(const Key& key, const Schema& schema) {
    const Value value = default_value(key, schema);
    if (key.kind == Kind::boolean) return std::get<std::int64_t>(value) != 0;
    // whole numbers are stored as doubles: an editor would show 1.0
    const bool whole = key.kind == Kind::counts || key.kind == Kind::integer_list;
    if (const auto* list = std::get_if<std::vector<double>>(&value); list && whole)
        return std::vector<std::int64_t>(list->begin(), list->end());
    return std::visit([](const auto& v) -> Json { return v; }, value);
}

Json key_schema(const Key& key, const Schema& schema) {
    Json out = value_schema(key);
    std::string text(key.doc);
    if (key.dimension == Dimension::share) text += " A number, or a text in %.";
    if (has_unit(key.dimension)) {
        text += fmt::format(" In {}, or a text with a unit: {}.", si_unit(key.dimension),
                            unit_names(key.dimension));
        // no keyword of JSON schema: the tables of the documents are made from it
        out["x-unit"] = si_unit(key.dimension);
    }
    if (key.default_text.empty()) {
        text += " Required.";
    } else if (key.default_text != "-") {
        // JSON has no infinity: the default is in words
        const Json value = default_json(key, schema);
        if (value.is_number_float() && !std::isfinite(value.get<double>()))
            text += fmt::format(" Default {}.", key.default_text);
        else
            out["default"] = value;
    }
    out["description"] = text;
    return out;
}

Json table_schema() {
    return {{"type", "object"}, {"additionalProperties", false}, {"properties", Json::object()}};
}

}  // namespace

std::string json_schema(const Schema& schema) {
    Json root = {{"$schema", "http://json-schema.org/draft-04/schema#"}, {"title", schema.title}};
    root.update(table_schema());
    // A key's path is its table's name and its own; the tables are made as their first key comes.
    for (const Key& key : schema.keys) {
        const auto dot = key.path.rfind('.');
        Json* table = &root;
        if (dot != std::string_view::npos) {
            const std::string name(key.path.substr(0, dot));
            const bool repeated = name == schema.repeated_table;
            Json& entry = root["properties"][name];
            if (entry.is_null() && repeated)
                entry = {{"type", "array"}, {"items", table_schema()}, {"minItems", 1}};
            else if (entry.is_null())
                entry = table_schema();
            table = repeated ? &entry["items"] : &entry;
            // a table with a required key is required itself, once
            if (key.default_text.empty() && !table->contains("required"))
                root["required"].push_back(name);
        }
        const std::string name(key.path.substr(dot + 1));  // of npos: the whole path
        (*table)["properties"][name] = key_schema(key, schema);
        if (key.default_text.empty()) (*table)["required"].push_back(name);
    }
    // exactly one of these keys must be given: the editor underlines a table that has none or both
    for (const auto& choice : schema.one_of) {
        const std::string table = choice.front().substr(0, choice.front().rfind('.'));
        Json& entry = root["properties"][table];
        for (const std::string& path : choice)
            entry["oneOf"].push_back({{"required", {path.substr(path.rfind('.') + 1)}}});
    }
    // [[floes]] may be missing where [level_ice] replaces it
    if (!schema.in_its_place.empty()) {
        for (const std::string& table : {schema.repeated_table, schema.in_its_place})
            root["anyOf"].push_back({{"required", {table}}});
    } else if (!schema.repeated_table.empty()) {
        root["required"].push_back(schema.repeated_table);
    }
    return root.dump(2) + "\n";
}

}  // namespace ice
