// SPDX-License-Identifier: GPL-3.0-or-later
/// Converts values of a case file to the members of a Case. For the tables of keys in this folder.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "common/geometry/triangle_mesh.hpp"
#include "common/toml/schema.hpp"

namespace ice::stored {

/// Values by their kind, in SI units; the schema has checked kind, length, unit and range.
inline double number(const Value& v) { return std::get<double>(v); }
inline int integer(const Value& v) { return static_cast<int>(std::get<std::int64_t>(v)); }
inline const std::string& text(const Value& v) { return std::get<std::string>(v); }
inline Vec3 vector3(const Value& v) {
    const auto& x = std::get<std::vector<double>>(v);
    return Vec3(x[0], x[1], x[2]);
}
/// z is NaN where it is left out.
inline Vec3 place3(const Value& v) {
    const auto& x = std::get<std::vector<double>>(v);
    return Vec3(x[0], x[1], x.size() > 2 ? x[2] : std::nan(""));
}
inline std::array<double, 2> vector2(const Value& v) {
    const auto& x = std::get<std::vector<double>>(v);
    return {x[0], x[1]};
}
inline std::array<double, 6> vector6(const Value& v) {
    std::array<double, 6> out{};
    const auto& x = std::get<std::vector<double>>(v);
    std::copy_n(x.begin(), out.size(), out.begin());
    return out;
}
/// Place of a word in its "a|b|c" list, from 0; the number of words where it is not there.
inline int place_in(const std::string& word, std::string_view choices) {
    int index = 0;
    for (std::size_t begin = 0; begin <= choices.size(); ++index) {
        const std::size_t end = std::min(choices.find('|', begin), choices.size());
        if (choices.substr(begin, end - begin) == word) break;
        begin = end + 1;
    }
    return index;
}
/// The choice as an enumerator: these are declared in the order of their "a|b|c" list.
template <class Enum>
Enum choice(const Value& v, std::string_view choices) {
    return static_cast<Enum>(place_in(text(v), choices));
}

}  // namespace ice::stored
