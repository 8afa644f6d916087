// SPDX-License-Identifier: GPL-3.0-or-later
/// Keys of a TOML input: one table per kind of file drives reading, range checks,
/// "did you mean", --explain, --print-defaults and --print-schema.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "common/base/units.hpp"

namespace ice {

/// The form of a key's value.
enum class Kind {
    number,
    integer,
    boolean,  ///< its value is 0 or 1
    text,
    path,
    choice,
    vector,  ///< of `length` numbers
    counts,  ///< of `length` whole numbers
    place,   ///< `length` numbers; the last one may be left out
    integer_list,
    pair_list,        ///< rows of a time and a number
    curve,            ///< rows of a speed and a number
    words,            ///< a list of choices
    choice_or_vector  ///< one of the choices, or `length` numbers
};

/// Numbers are in SI; pairs are (time [s], value) or (speed [m/s], value).
using Value = std::variant<double, std::int64_t, std::string, std::vector<double>,
                           std::vector<std::pair<double, double>>, std::vector<std::string>>;

/// One key of an input file.
struct Key {
    std::string_view path;  ///< "contact.restitution"; of repeated tables: "floes.gap"
    Kind kind;
    Dimension dimension;
    std::string_view
        default_text;          ///< TOML literal; "" when the key is required, "-" when optional
    double low, high;          ///< inclusive range of each number, SI
    std::size_t length;        ///< of a vector: count of its numbers; 0 for others
    std::string_view choices;  ///< "grid|brick|single|file"; "" for none
    std::string_view doc;      ///< one sentence
};

/// All keys of one kind of input file.
struct Schema {
    std::vector<Key> keys;       ///< in the order in which they are shown
    std::string repeated_table;  ///< "floes" where [[floes]] may be given many times; "" for none
    std::string program;         ///< whose --print-defaults lists the keys
    std::string title;           ///< "icesolve case"
    std::vector<std::vector<std::string>> one_of;  ///< keys of a table that exclude each other
    std::string in_its_place = {};  ///< a table that may replace repeated_table; "" none
    /// Of keys with choices: who has others, for a value that is none of them and near none.
    std::map<std::string, std::string, std::less<>> elsewhere = {};

    /// The key of that path, or null.
    const Key* find(std::string_view path) const;
    /// The most similar known key, or "" when none is near: nearest_name().
    std::string nearest(std::string_view path) const;
    /// The tables that hold the keys, in their order: "simulation", "floes", ...
    std::vector<std::string> tables() const;
};

/// Text of `--explain KEY`; of a table, all its keys.
/// @throws Error (exit code 2) for an unknown key.
std::string explain_key(const Schema& schema, const std::string& path);
/// Name of the JSON schema in a file's "#:schema" line: "case.schema.json".
std::string schema_file_name(const Schema& schema);
/// A complete file with all defaults, as TOML; its first line names the schema.
std::string default_text(const Schema& schema);
/// JSON schema of the file, for editors: types, units, bounds, sizes, choices, defaults, what is
/// required. It accepts every file that the reader accepts. Only the reader sees missing files,
/// bounds of texts with units, times that must grow, keys that belong together.
/// Draft 4, which taplo (the language server of TOML) and python3-jsonschema know.
std::string json_schema(const Schema& schema);

}  // namespace ice
