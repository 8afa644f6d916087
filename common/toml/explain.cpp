// SPDX-License-Identifier: GPL-3.0-or-later
// The schema table as text: for people (--explain, --print-defaults) and editors (--print-schema).
#include <fmt/format.h>

#include <cmath>

#include "common/base/error.hpp"
#include "common/toml/schema.hpp"

namespace ice {

namespace {

std::string kind_text(const Key& key) {
    switch (key.kind) {
        case Kind::number:
            return "number";
        case Kind::integer:
            return "integer";
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
    }
    return "";
}

std::string default_note(const Key& key) {
    if (key.default_text.empty()) return "required";
    if (key.default_text == "-") return "optional";
    return "default " + std::string(key.default_text);
}

bool has_range(const Key& key) {
    return key.kind != Kind::text && key.kind != Kind::path && key.kind != Kind::choice;
}

std::string json_type(const Key& key) {
    switch (key.kind) {
        case Kind::integer:
            return R"("type": "integer")";
        case Kind::text:
        case Kind::path:
            return R"("type": "string")";
        case Kind::choice: {
            std::string list(key.choices);
            for (std::size_t at = 0; (at = list.find('|', at)) != std::string::npos; at += 4)
                list.replace(at, 1, "\", \"");
            return "\"enum\": [\"" + list + "\"]";
        }
        case Kind::vector:
        case Kind::counts:
        case Kind::place:
        case Kind::integer_list:
        case Kind::pair_list:
            return R"("type": "array")";
        case Kind::number:
            break;
    }
    return R"("type": ["number", "string"])";  // a string carries a unit
}

std::string table_of(const Key& key) {
    const auto dot = key.path.rfind('.');
    return dot == std::string_view::npos ? "" : std::string(key.path.substr(0, dot));
}

}  // namespace

std::string explain_key(const Schema& schema, const std::string& path) {
    const Key* key = schema.find(path);
    if (key == nullptr) {
        const std::string near = schema.nearest(path);
        throw bad_input("--explain", "no key is called '" + path + "'",
                        near.empty() ? schema.program + " --print-defaults lists all keys"
                                     : "did you mean '" + near + "'?");
    }
    std::string out =
        fmt::format("{}\n  {}\n  {}, {}", key->path, key->doc, kind_text(*key), default_note(*key));
    if (has_range(*key)) out += fmt::format(", from {:g} to {:g}", key->low, key->high);
    if (key->dimension != Dimension::none)
        out +=
            fmt::format(", in {} (units: {})", si_unit(key->dimension), unit_names(key->dimension));
    return out + "\n";
}

std::string default_text(const Schema& schema) {
    std::string out, table;
    for (const Key& key : schema.keys) {
        if (const std::string now = table_of(key); now != table) {
            out += now == schema.repeated_table ? fmt::format("\n[[{}]]\n", now)
                                                : fmt::format("\n[{}]\n", now);
            table = now;
        }
        const auto name = key.path.substr(key.path.rfind('.') + 1);
        const bool has_default = !key.default_text.empty() && key.default_text != "-";
        out += fmt::format("{}{} = {}  # {} ({})\n", has_default ? "" : "# ", name,
                           has_default ? key.default_text : "...", key.doc, kind_text(key));
    }
    return out;
}

std::string json_schema(const Schema& schema) {
    std::string out = fmt::format(
        "{{\n  \"$schema\": \"http://json-schema.org/draft-04/schema#\",\n"
        "  \"title\": \"{}\",\n  \"type\": \"object\",\n"
        "  \"additionalProperties\": false,\n  \"properties\": {{",
        schema.title);
    std::string table, separator;
    const auto close_table = [&] {
        if (table == schema.repeated_table && !table.empty())
            out += "\n    } } }";
        else if (!table.empty())
            out += "\n    } }";
    };
    for (const Key& key : schema.keys) {
        const std::string now = table_of(key);
        const std::string name(key.path.substr(key.path.rfind('.') + 1));
        if (now != table) {
            close_table();
            const std::string open =
                R"("type": "object", "additionalProperties": false, "properties": {)";
            out += fmt::format(
                "{}\n    \"{}\": {{ {}", separator, now,
                now == schema.repeated_table ? R"("type": "array", "items": { )" + open : open);
            table = now;
            separator = "";
        }
        out += fmt::format("{}\n      \"{}\": {{ {}, \"description\": \"{}\" }}", separator, name,
                           json_type(key), key.doc);
        separator = ",";
    }
    close_table();
    return out + "\n  }\n}\n";
}

}  // namespace ice
