// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/run/check_inputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <string_view>

namespace ice {

namespace {

// A unit by its factor to SI; the first of a list is the SI unit, the others are larger.
struct InputUnit {
    double factor;
    std::string_view name;
};

constexpr InputUnit kDensityUnits[] = {{1.0, "kg/m3"}, {1e3, "t/m3"}};
constexpr InputUnit kPressureUnits[] = {{1.0, "Pa"}, {1e3, "kPa"}, {1e6, "MPa"}, {1e9, "GPa"}};

// Values that ice has, in nature or in a model basin [SI]; wider ranges warn of fewer slips, no
// number changes.
struct UsualRange {
    std::string_view key;
    double low, high;
    double usual;  // decides between two units that may be meant
    std::string_view bounds, examples;
    std::span<const InputUnit> units;
};

// Sea ice 840 to 910 above and 900 to 940 kg/m3 below the water line (Timco and Frederking 1996);
// lake ice 917; paraffin and polypropylene of basins about 900.
constexpr UsualRange kDensity{.key = "ice.density",
                              .low = 850.0,
                              .high = 940.0,
                              .usual = 900.0,
                              .bounds = "850 to 940 kg/m3",
                              .examples = "900 is common",
                              .units = kDensityUnits};
constexpr UsualRange kCrushing{.key = "contact.crushing_pressure",
                               .low = 1e4,
                               .high = 1e8,
                               .usual = kCrushingPressure,
                               .bounds = "10 kPa to 100 MPa",
                               .examples = "0.5 to 3 MPa are common",
                               .units = kPressureUnits};
constexpr UsualRange kStrength{.key = "bending.flexural_strength",
                               .low = 1e4,
                               .high = 1e7,
                               .usual = 5e5,
                               .bounds = "10 kPa to 10 MPa",
                               .examples = "0.2 to 1 MPa are common, 20 to 60 kPa in model basins",
                               .units = kPressureUnits};
constexpr UsualRange kModulus{.key = "bending.elastic_modulus",
                              .low = 5e8,
                              .high = 1.2e10,
                              .usual = 5e9,
                              .bounds = "0.5 to 12 GPa",
                              .examples = "1 to 10 GPa are common",
                              .units = kPressureUnits};
// of ice as weak as that of model basins
constexpr UsualRange kModelModulus{.key = "bending.elastic_modulus",
                                   .low = 1e6,
                                   .high = 1.2e10,
                                   .usual = 1e8,
                                   .bounds = "1 MPa to 12 GPa",
                                   .examples = "10 to 500 MPa are common in model basins",
                                   .units = kPressureUnits};
// Strength below which ice is a model basin's [Pa].
constexpr double kModelStrength = 1e5;

// In the largest unit in which the number is 1 or more.
std::string in_own_unit(double value, std::span<const InputUnit> units) {
    const InputUnit* unit = &units.front();
    for (const InputUnit& larger : units)
        if (value >= larger.factor) unit = &larger;
    return fmt::format("{:g} {}", value / unit->factor, unit->name);
}

// What the number is when it was meant in a larger unit, or given in one that is too large, and
// comes into the range by that; "" where no unit does this.
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

// @param share  of the mean that depends on it at most [-]
void warn_of_value(const UsualRange& range, double value, double share,
                   std::vector<Warning>& warnings) {
    const std::string meant = meant_value(range, value);
    warnings.push_back(
        judged(fmt::format("{} = {:g} {} is outside {}; {}: {}", range.key, value,
                           range.units.front().name, range.bounds, range.examples,
                           meant.empty() ? "check the number and its unit"
                                         : fmt::format("if {0} is meant, write \"{0}\"", meant)),
               std::min(share, 1.0)));
}

// A strength or a stiffness: forces grow no faster than it does, so the mean is off by no more than
// its ratio to the range.
void check_pressure(const UsualRange& range, double value, std::vector<Warning>& warnings) {
    if (value >= range.low && value <= range.high) return;
    const double ratio = value < range.low ? range.low / value : value / range.high;
    warn_of_value(range, value, ratio - 1.0, warnings);
}

// Of a density the weight in water counts, which presses floes against the hull.
void check_density(const Case& p, std::vector<Warning>& warnings) {
    const double value = p.ice_density;
    if (value >= kDensity.low && value <= kDensity.high) return;
    const double bound = std::clamp(value, kDensity.low, kDensity.high);
    const double usual = p.water_density - bound, given = p.water_density - value;
    warn_of_value(kDensity, value, usual > 0.0 ? std::abs(given / usual - 1.0) : 1.0, warnings);
}

}  // namespace

std::vector<Warning> check_inputs(const Case& parameters) {
    std::vector<Warning> warnings;
    check_density(parameters, warnings);
    // rigid ice is a choice
    if (!parameters.contact.is_rigid())
        check_pressure(kCrushing, parameters.contact.crushing_pressure, warnings);
    if (parameters.has_bending()) {
        check_pressure(kStrength, parameters.bending.flexural_strength, warnings);
        const bool is_model = parameters.bending.flexural_strength < kModelStrength;
        check_pressure(is_model ? kModelModulus : kModulus, parameters.bending.elastic_modulus,
                       warnings);
    }
    return warnings;
}

}  // namespace ice
