// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/base/units.hpp"

#include <array>
#include <charconv>

namespace ice {

namespace {

struct Unit {
    std::string_view name;
    double factor;  ///< SI = number * factor
    Dimension dimension;
};

// the first unit of each dimension that has one is the SI one
constexpr std::array kUnits{
    Unit{"%", 0.01, Dimension::share},
    Unit{"m", 1.0, Dimension::length},
    Unit{"km", 1000.0, Dimension::length},
    Unit{"cm", 0.01, Dimension::length},
    Unit{"mm", 0.001, Dimension::length},
    Unit{"ft", 0.3048, Dimension::length},
    Unit{"in", 0.0254, Dimension::length},
    Unit{"s", 1.0, Dimension::time},
    Unit{"ms", 0.001, Dimension::time},
    Unit{"min", 60.0, Dimension::time},
    Unit{"h", 3600.0, Dimension::time},
    Unit{"m/s", 1.0, Dimension::speed},
    Unit{"km/h", 1.0 / 3.6, Dimension::speed},
    Unit{"kn", kKnot, Dimension::speed},
    Unit{"rad/s", 1.0, Dimension::angular_speed},
    Unit{"deg/s", kDegree, Dimension::angular_speed},
    Unit{"m/s2", 1.0, Dimension::acceleration},
    Unit{"Pa", 1.0, Dimension::pressure},
    Unit{"kPa", 1e3, Dimension::pressure},
    Unit{"MPa", 1e6, Dimension::pressure},
    Unit{"GPa", 1e9, Dimension::pressure},
    Unit{"kg/m3", 1.0, Dimension::density},
    Unit{"t/m3", 1000.0, Dimension::density},
    Unit{"rad", 1.0, Dimension::angle},
    Unit{"deg", kDegree, Dimension::angle},
    Unit{"kg", 1.0, Dimension::mass},
    Unit{"t", 1e3, Dimension::mass},
    Unit{"N", 1.0, Dimension::force},
    Unit{"kN", 1e3, Dimension::force},
    Unit{"MN", 1e6, Dimension::force},
    Unit{"W", 1.0, Dimension::power},
    Unit{"kW", 1e3, Dimension::power},
    Unit{"MW", 1e6, Dimension::power},
};

std::string_view trim(std::string_view text) {
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
    return text;
}

}  // namespace

std::optional<Quantity> parse_quantity(std::string_view text, Dimension dimension) {
    text = trim(text);
    // std::from_chars, not strtod: it takes a decimal point in every locale.
    // from_chars accepts no leading plus
    if (text.starts_with('+')) text.remove_prefix(1);
    double number = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{}) return std::nullopt;
    const std::string_view name = trim(text.substr(static_cast<std::size_t>(end - text.data())));
    if (name.empty()) return Quantity{number, false};
    for (const Unit& unit : kUnits)
        if (unit.dimension == dimension && unit.name == name)
            // a unit's name alone is no key: "m" is a length, "min" a time
            return Quantity{number * unit.factor, true};
    return std::nullopt;
}

std::string unit_names(Dimension dimension) {
    std::string names;
    for (const Unit& unit : kUnits)
        if (unit.dimension == dimension)
            names += (names.empty() ? "" : ", ") + std::string(unit.name);
    return names;
}

bool has_unit(Dimension dimension) {
    return dimension != Dimension::none && dimension != Dimension::share;
}

std::string_view si_unit(Dimension dimension) {
    if (!has_unit(dimension)) return "1";
    for (const Unit& unit : kUnits)
        if (unit.dimension == dimension) return unit.name;
    return "1";
}

}  // namespace ice
