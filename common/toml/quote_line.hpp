// SPDX-License-Identifier: GPL-3.0-or-later
/// A line of an input as a message shows it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace ice {

/// The characters of a text, each as UTF-8 that a terminal can show: bytes that are no UTF-8 and
/// control characters become U+FFFD, a tab one space.
std::vector<std::string> printable_characters(std::string_view text);

/// Two lines: "   12 | the line" and carets under `width` of its characters (at least one), from
/// the character `at` (from 0) on. Of a long line only the text around them.
/// @param number  of the line, from 1
std::string quote_line(std::string_view line, std::size_t number, std::size_t at,
                       std::size_t width);

/// Probable meaning of a line `key = value` whose value is no TOML: a
/// decimal comma, a unit or a text without quotes. A clause with the remedy, or "".
std::string explain_value(std::string_view line);

/// True for a number with a decimal comma: "0,3", "-1,5 m".
bool has_decimal_comma(std::string_view value);

}  // namespace ice
