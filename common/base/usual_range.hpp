// SPDX-License-Identifier: GPL-3.0-or-later
/// Values that a quantity has in nature or in a model basin: a number outside them is most often
/// one in a wrong unit.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace ice {

/// A unit by its factor to SI; the first of a list is the SI unit, the others are larger.
struct InputUnit {
    double factor;
    std::string_view name;
};

inline constexpr InputUnit kPressureUnits[] = {
    {1.0, "Pa"}, {1e3, "kPa"}, {1e6, "MPa"}, {1e9, "GPa"}};

/// Usual values of a quantity [SI]; wider ranges warn of fewer slips, no number changes.
struct UsualRange {
    double low, high;
    double usual;  ///< decides between two units that may be meant
    std::string_view bounds, examples;
    std::span<const InputUnit> units;
};

inline constexpr UsualRange kUsualStrength{
    .low = 1e4,
    .high = 1e7,
    .usual = 5e5,
    .bounds = "10 kPa to 10 MPa",
    .examples = "0.2 to 1 MPa are common, 20 to 60 kPa in model basins",
    .units = kPressureUnits};

/// "NAME = 450 Pa is outside 10 kPa to 10 MPa; ...: if 450 kPa is meant, write "450 kPa""; "" for a
/// value inside the range.
std::string outside_usual(const UsualRange& range, std::string_view name, double value);

}  // namespace ice
