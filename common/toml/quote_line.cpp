// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/toml/quote_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>

namespace ice {

namespace {

// Characters of a line that a message shows [-]: one or two rows of a terminal. Fewer hide the
// context of a mistake, more let a generated file's line fill the screen.
constexpr std::size_t kMostOfLine = 120;
// U+FFFD, the character that takes the place of an unreadable one, as UTF-8.
const char* const kReplacement = "\xEF\xBF\xBD";

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

// length of the UTF-8 sequence at the front of a text, 0 when there is none
std::size_t sequence_length(std::string_view text) {
    const auto first = static_cast<unsigned char>(text.front());
    // by the first byte's leading bits; C0, C1 and F5 to FF begin no valid sequence
    const std::size_t length = first < 0x80                    ? 1
                               : first >= 0xC2 && first < 0xE0 ? 2
                               : first >= 0xE0 && first < 0xF0 ? 3
                               : first >= 0xF0 && first < 0xF5 ? 4
                                                               : 0;
    if (length > text.size()) return 0;
    for (std::size_t k = 1; k < length; ++k)
        if ((static_cast<unsigned char>(text[k]) & 0xC0) != 0x80) return 0;
    // U+0080 to U+009F are control characters as well
    if (first == 0xC2 && static_cast<unsigned char>(text[1]) < 0xA0) return 0;
    return length;
}

std::string_view trim(std::string_view text) {
    const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
    while (!text.empty() && blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && blank(text.back())) text.remove_suffix(1);
    return text;
}

// the text behind the number at its front; all of it where there is none
std::string_view behind_number(std::string_view text) {
    double number = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{}) return text;
    return text.substr(static_cast<std::size_t>(end - text.data()));
}

}  // namespace

std::vector<std::string> printable_characters(std::string_view text) {
    std::vector<std::string> out;
    while (!text.empty()) {
        // Whole characters, not bytes: carets mark them from below, and a terminal shows no half of
        // one. Control characters could write over the message.
        const std::size_t length = sequence_length(text);
        const auto c = static_cast<unsigned char>(text.front());
        if (c == '\t')
            out.emplace_back(" ");
        else if (length == 0 || c < 0x20 || c == 0x7F)
            out.emplace_back(kReplacement);
        else
            out.emplace_back(text.substr(0, length));
        text.remove_prefix(std::max<std::size_t>(length, 1));
    }
    return out;
}

std::string quote_line(std::string_view line, std::size_t number, std::size_t at,
                       std::size_t width) {
    if (line.ends_with('\r')) line.remove_suffix(1);
    const std::vector<std::string> all = printable_characters(line);
    // a window of the line around the mistake: lines of generated files may be very long
    const std::size_t first = at > kMostOfLine / 2 ? at - kMostOfLine / 2 : 0;
    std::string part;
    for (std::size_t k = first; k < std::min(first + kMostOfLine, all.size()); ++k) part += all[k];
    if (first + kMostOfLine < all.size()) part += "...";
    return fmt::format("\n{:5} | {}\n      | {}{}", number, part, std::string(at - first, ' '),
                       std::string(std::clamp<std::size_t>(width, 1, kMostOfLine), '^'));
}

bool has_decimal_comma(std::string_view value) {
    const std::string_view rest = behind_number(trim(value));
    // one comma with digits behind it; two or more are a list
    return rest.size() < value.size() && rest.size() > 1 && rest[0] == ',' && is_digit(rest[1]) &&
           behind_number(rest.substr(1)).find(',') == std::string_view::npos;
}

std::string explain_value(std::string_view line) {
    const auto equals = line.find('=');
    // a comment with a '=' in it is no assignment
    if (equals == std::string_view::npos || line.find('#') < equals) return "";
    const std::string_view value = trim(line.substr(equals + 1, line.find('#') - equals - 1));
    if (value.empty()) return "";
    if (has_decimal_comma(value)) return "; the decimal point is '.', not ','";
    // a word behind a number is a unit without quotes, a word alone a text without quotes
    const std::string_view unit = trim(behind_number(value));
    if (unit.empty() || !(is_letter(unit.front()) || unit.front() == '%')) return "";
    const std::string shown = fmt::format("{}", fmt::join(printable_characters(value), ""));
    return unit.size() < value.size()
               ? fmt::format("; write a number with a unit in quotes: \"{}\"", shown)
               : fmt::format("; write a text in quotes: \"{}\"", shown);
}

}  // namespace ice
