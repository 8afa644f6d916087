// SPDX-License-Identifier: GPL-3.0-or-later
// The schema table as text for people: --explain and --print-defaults.
#include <fmt/format.h>

#include <cmath>

#include "common/base/error.hpp"
#include "common/toml/schema.hpp"

namespace ice {

namespace {

std::string kind_text(const Key& key) {
    // in the words of a message: the form that the user has to write
    switch (key.kind) {
        case Kind::number:
            return "number";
        case Kind::integer:
            return "integer";
        case Kind::boolean:
            return "true or false";
        case Kind::text:
            return "text";
        case Kind::path:
            return "path";
        case Kind::choice:
            return "one of " + std::string(key.choices);
        case Kind::vector:
        case Kind::place:
            return fmt::format("list of {} numbers", key.length);
        case Kind::counts:
            return fmt::format("list of {} whole numbers", key.length);
        case Kind::integer_list:
            return "list of integers";
        case Kind::pair_list:
            return "list of [t, u]";
        case Kind::curve:
            return "list of [speed, value]";
        case Kind::words:
            return "list of " + std::string(key.choices);
        case Kind::choice_or_vector:
            return fmt::format("one of {}, or list of {} numbers", key.choices, key.length);
    }
    return "";
}

std::string default_note(const Key& key) {
    if (key.default_text.empty()) return "required";
    // "-": left out, the program chooses, by the rule in the description
    if (key.default_text == "-") return "optional";
    return "default " + std::string(key.default_text);
}

bool has_range(const Key& key) {
    return key.kind != Kind::text && key.kind != Kind::path && key.kind != Kind::choice &&
           key.kind != Kind::boolean && key.kind != Kind::words;
}

std::string table_of(const Key& key) {
    const auto dot = key.path.rfind('.');
    return dot == std::string_view::npos ? "" : std::string(key.path.substr(0, dot));
}

}  // namespace

std::string explain_key(const Schema& schema, const std::string& path) {
    const Key* key = schema.find(path);
    if (key == nullptr) {
        // the name of a table explains all of its keys
        std::string table;  // explanations of all its keys
        for (const Key& inner : schema.keys)
            if (inner.path.starts_with(path + "."))
                table += explain_key(schema, std::string(inner.path));
        if (!table.empty()) return table;
        const std::string near = schema.nearest(path);
        throw bad_input("--explain", "no key is called '" + path + "'",
                        near.empty() ? schema.program + " --print-defaults lists all keys"
                                     : "did you mean '" + near + "'?");
    }
    // sentence, form, default, then the range and the units, where the key has them
    std::string out =
        fmt::format("{}\n  {}\n  {}, {}", key->path, key->doc, kind_text(*key), default_note(*key));
    if (has_range(*key)) out += fmt::format(", from {:g} to {:g}", key->low, key->high);
    if (has_unit(key->dimension))
        out +=
            fmt::format(", in {} (units: {})", si_unit(key->dimension), unit_names(key->dimension));
    return out + "\n";
}

std::string schema_file_name(const Schema& schema) {
    return schema.title.substr(schema.title.rfind(' ') + 1) + ".schema.json";
}

std::string default_text(const Schema& schema) {
    const std::string name = schema_file_name(schema);
    std::string out = fmt::format(
        "#:schema {0}\n# for editors, made by: {1} --print-schema > {0}\n", name, schema.program);
    std::string table;
    for (const Key& key : schema.keys) {
        // keys are in the order of their tables: a new name begins a new table
        if (const std::string now = table_of(key); now != table) {
            out += now == schema.repeated_table ? fmt::format("\n[[{}]]\n", now)
                                                : fmt::format("\n[{}]\n", now);
            table = now;
        }
        const auto leaf = key.path.substr(key.path.rfind('.') + 1);
        const bool has_default = !key.default_text.empty() && key.default_text != "-";
        // keys without a default are comments, for the user to fill in or leave
        out += fmt::format("{}{} = {}  # {} ({})\n", has_default ? "" : "# ", leaf,
                           has_default ? key.default_text : "...", key.doc, kind_text(key));
    }
    return out;
}

}  // namespace ice
