// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/run/check_inputs.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "common/base/usual_range.hpp"

namespace ice {

namespace {

constexpr InputUnit kDensityUnits[] = {{1.0, "kg/m3"}, {1e3, "t/m3"}};

// Sea ice 840 to 910 above and 900 to 940 kg/m3 below the water line (Timco and Frederking 1996);
// lake ice 917; paraffin and polypropylene of basins about 900.
constexpr UsualRange kDensity{.low = 850.0,
                              .high = 940.0,
                              .usual = 900.0,
                              .bounds = "850 to 940 kg/m3",
                              .examples = "900 is common",
                              .units = kDensityUnits};
constexpr UsualRange kCrushing{.low = 1e4,
                               .high = 1e8,
                               .usual = kCrushingPressure,
                               .bounds = "10 kPa to 100 MPa",
                               .examples = "0.5 to 3 MPa are common",
                               .units = kPressureUnits};
constexpr UsualRange kModulus{.low = 5e8,
                              .high = 1.2e10,
                              .usual = 5e9,
                              .bounds = "0.5 to 12 GPa",
                              .examples = "1 to 10 GPa are common",
                              .units = kPressureUnits};
// of ice as weak as that of model basins
constexpr UsualRange kModelModulus{.low = 1e6,
                                   .high = 1.2e10,
                                   .usual = 1e8,
                                   .bounds = "1 MPa to 12 GPa",
                                   .examples = "10 to 500 MPa are common in model basins",
                                   .units = kPressureUnits};
// Strength below which ice is a model basin's [Pa].
constexpr double kModelStrength = 1e5;

// Warns of a value outside its range.
// @param share  of the mean that depends on it at most [-]
void warn_of_value(const UsualRange& range, std::string_view key, double value, double share,
                   std::vector<Warning>& warnings) {
    warnings.push_back(judged(outside_usual(range, key, value), std::min(share, 1.0)));
}

// A strength or a stiffness: forces grow no faster than it does, so the mean is off by no more than
// its ratio to the range.
void check_pressure(const UsualRange& range, std::string_view key, double value,
                    std::vector<Warning>& warnings) {
    if (value >= range.low && value <= range.high) return;
    const double ratio = value < range.low ? range.low / value : value / range.high;
    warn_of_value(range, key, value, ratio - 1.0, warnings);
}

// Of a density the weight in water counts, which presses floes against the hull.
void check_density(const Case& p, std::vector<Warning>& warnings) {
    const double value = p.ice_density;
    if (value >= kDensity.low && value <= kDensity.high) return;
    const double bound = std::clamp(value, kDensity.low, kDensity.high);
    const double usual = p.water_density - bound, given = p.water_density - value;
    warn_of_value(kDensity, "ice.density", value, usual > 0.0 ? std::abs(given / usual - 1.0) : 1.0,
                  warnings);
}

}  // namespace

std::vector<Warning> check_inputs(const Case& parameters) {
    std::vector<Warning> warnings;
    check_density(parameters, warnings);
    // rigid ice is a choice
    if (!parameters.contact.is_rigid())
        check_pressure(kCrushing, "contact.crushing_pressure", parameters.contact.crushing_pressure,
                       warnings);
    if (parameters.has_bending()) {
        check_pressure(kUsualStrength, "bending.flexural_strength",
                       parameters.bending.flexural_strength, warnings);
        const bool is_model = parameters.bending.flexural_strength < kModelStrength;
        check_pressure(is_model ? kModelModulus : kModulus, "bending.elastic_modulus",
                       parameters.bending.elastic_modulus, warnings);
    }
    return warnings;
}

}  // namespace ice
