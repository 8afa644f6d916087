// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/formulas/spencer.hpp"

#include <cmath>

namespace ice {

SpencerScales spencer_scales(const HullDimensions& hull, const IceConditions& ice) {
    // The dimensionless numbers divide speeds: Fr_h by that of a wave in water as deep as the ice,
    // S by that of the inertia against the strength. NaN strength gives NaN S alone.
    const double h = ice.thickness, v = ice.speed, b = hull.breadth;
    return {(ice.water_density - ice.ice_density) * ice.gravity * h * b * hull.draught,
            ice.ice_density * b * h * v * v, v / std::sqrt(ice.gravity * h),
            v * std::sqrt(ice.ice_density * b / (ice.flexural_strength * h))};
}

SpencerParts spencer_resistance(const HullDimensions& hull, const IceConditions& ice,
                                const SpencerCoefficients& c) {
    // (F3), term by term
    const SpencerScales s = spencer_scales(hull, ice);
    // 0 V^2 and 0^-a at rest: the limit, not NaN
    const auto power = [&](double number, double exponent) {
        return number == 0.0 ? 0.0 : std::pow(number, -exponent) * s.inertia;
    };
    return {c.buoyancy * s.weight, c.clearing * power(s.froude, c.clearing_exponent),
            c.breaking * power(s.strength, c.breaking_exponent)};
}

}  // namespace ice
