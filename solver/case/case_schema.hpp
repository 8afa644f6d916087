// SPDX-License-Identifier: GPL-3.0-or-later
/// One table of all case keys. It drives reading, range checks, "did you mean", --explain,
/// --print-defaults, --print-schema and the resolved case.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "common/base/units.hpp"
#include "solver/case/case.hpp"

namespace ice {

enum class Kind { number, integer, text, path, choice, vector, integer_list, pair_list };

using Value = std::variant<double, std::int64_t, std::string, std::vector<double>,
                           std::vector<std::pair<double, double>>>;

/// One key of the case file.
struct Key {
    std::string_view path;  ///< "contact.restitution"; of [[floes]]: "floes.gap"
    Kind kind;
    Dimension dimension;
    std::string_view
        default_text;          ///< TOML literal; "" when the key is required, "-" when optional
    double low, high;          ///< inclusive range of each number, SI
    std::size_t length;        ///< of a vector
    std::string_view choices;  ///< "grid|brick|single|file"
    std::string_view doc;      ///< one sentence
    void (*store)(Case&, FloeGroup&, const Value&);
};

/// All keys in the order of the contract.
const std::vector<Key>& case_keys();

/// The key of that path, or null.
const Key* find_key(std::string_view path);

/// The most similar known key, or "" when none is near (edit distance above a quarter of the name).
std::string nearest_key(std::string_view path);

/// Text of `icesolve --explain KEY`. @throws Error (exit code 2) for an unknown key.
std::string explain_key(const std::string& path);
/// A complete case with all defaults, as TOML.
std::string default_case_text();
/// JSON schema (draft 4) of the case file, for editors.
std::string case_json_schema();

}  // namespace ice
