// SPDX-License-Identifier: GPL-3.0-or-later
/// One value of a TOML file, checked against its key. For read_toml.cpp: toml++ stays behind it.
#pragma once

// Debian's libtomlplusplus.so holds the version that throws
#define TOML_HEADER_ONLY 0
#include <toml++/toml.h>

#include <string>
#include <string_view>
#include <vector>

#include "common/toml/read_toml.hpp"

namespace ice {

/// Writes mistakes with the place and the line of the text they are in.
class Complaints {
public:
    /// @param name  of the text in messages: the file, or an option with its value
    /// @param is_file  else the text is one line, and a place in it says nothing
    Complaints(const std::string& text, std::string name, Mistakes& mistakes, bool is_file);

    /// Adds "place: error: what" with the line and carets under `width` characters.
    void add(const toml::source_region& where, const std::string& what, std::size_t width);
    /// "name:line:column", of an option its name.
    std::string place(const toml::source_region& where) const;
    /// A line of the text, from 1; "" where there is none.
    std::string_view line(std::size_t number) const;

private:
    std::string name_;
    Mistakes& mistakes_;
    bool is_file_;
    std::vector<std::string> lines_;
};

/// Reads a node as the value of a key: type, unit, range, length. Of one that does not fit it
/// complains and returns false.
/// @param elsewhere  of a key with choices: who has others; "" nobody
/// @param out  in SI; unchanged where false
bool read_value(const Key& key, const toml::node& node, const std::string& elsewhere,
                Complaints& complaints, Value& out);

}  // namespace ice
