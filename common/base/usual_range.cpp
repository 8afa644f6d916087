// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/base/usual_range.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace ice {

namespace {

// In the largest unit in which the number is 1 or more.
std::string in_own_unit(double value, std::span<const InputUnit> units) {
    const InputUnit* unit = &units.front();
    for (const InputUnit& larger : units)
        if (value >= larger.factor) unit = &larger;
    return fmt::format("{:g} {}", value / unit->factor, unit->name);
}

// The value in the unit that was probably meant: a larger or a smaller one that brings the number
// into the range; "" where no unit does this.
std::string meant_value(const UsualRange& range, double value) {
    std::string text;
    double nearest = std::numeric_limits<double>::infinity();
    const auto consider = [&](double candidate, const std::string& as_text) {
        if (candidate < range.low || candidate > range.high) return;
        const double distance = std::abs(std::log(candidate / range.usual));
        if (distance >= nearest) return;
        nearest = distance;
        text = as_text;
    };
    for (const InputUnit& unit : range.units.subspan(1)) {
        // as it was written, unless that is a number of many digits
        consider(value * unit.factor, value < 1e3 ? fmt::format("{:g} {}", value, unit.name)
                                                  : in_own_unit(value * unit.factor, range.units));
        consider(value / unit.factor, in_own_unit(value / unit.factor, range.units));
    }
    return text;
}

}  // namespace

std::string outside_usual(const UsualRange& range, std::string_view name, double value) {
    if (value >= range.low && value <= range.high) return "";
    const std::string meant = meant_value(range, value);
    return fmt::format("{} = {:g} {} is outside {}; {}: {}", name, value, range.units.front().name,
                       range.bounds, range.examples,
                       meant.empty() ? "check the number and its unit"
                                     : fmt::format("if {0} is meant, write \"{0}\"", meant));
}

}  // namespace ice
