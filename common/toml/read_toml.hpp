// SPDX-License-Identifier: GPL-3.0-or-later
/// A TOML input or an override as checked values; the only header behind which toml++ is used.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "common/toml/schema.hpp"

namespace ice {

/// Mistakes found so far, each "file:line:column: error: ..." with the line and a caret under it.
/// In a file full of mistakes the first are kept, the others counted.
struct Mistakes {
    /// Mistakes with a text of their own: a screen full. The others are counted.
    static constexpr std::size_t kMost = 20;

    std::vector<std::string> texts;
    std::size_t more = 0;            ///< not kept
    std::set<std::string> bad_keys;  ///< keys given with a bad value: not missing as well
    std::map<std::string, std::string> places;  ///< "file:line:column" of each key given, or
                                                ///< "--set key=value"
    std::string remedy;                         ///< of the one mistake that explains all; else ""

    bool full() const { return texts.size() >= kMost; }
    void add(const std::string& text) {
        if (full())
            ++more;
        else
            texts.push_back(text);
    }
};

/// Values of the keys given, checked against the schema. Keys of the repeated table carry its
/// number, from 0: "floes.0.gap"; an override without a number is kept as "floes.gap".
using Values = std::map<std::string, Value>;

/// Parses TOML and checks it. Mistakes are collected, never thrown.
/// @param name   of the file, in messages
/// @param groups  the number of repeated tables so far, increased by those of the text
Values read_toml(const std::string& text, const std::string& name, const Schema& schema,
                 Mistakes& mistakes, std::size_t& groups);

/// Parses one `key=value` override: the value as TOML, or as text where that fails. Its mistakes
/// begin with "--set key=value".
/// @param groups  repeated tables of the file; an override of another is a mistake
Values read_override(const std::string& text, const Schema& schema, std::size_t groups,
                     Mistakes& mistakes);

/// The value of a key's default_text, in SI. @pre it has one
Value default_value(const Key& key, const Schema& schema);

}  // namespace ice
