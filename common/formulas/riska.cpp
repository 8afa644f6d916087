// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/formulas/riska.hpp"

#include <cmath>
#include <numbers>

namespace ice {

double riska_resistance(const HullDimensions& hull, const IceConditions& ice) {
    // (F2): C_1 is at_rest, C_2 per_speed [kN, kN s/m]
    const double phi = hull.stem_angle * 180.0 / std::numbers::pi;
    const double b = hull.breadth, t = hull.draught, h = ice.thickness, bow = hull.bow_length;
    const double at_rest =
        0.23 / (2.0 * t / b + 1.0) * b * hull.parallel_length * h +
        (1.0 + 0.021 * phi) * (4.58 * b * h * h + 1.47 * bow * h * h + 0.29 * b * bow * h);
    const double per_speed = (1.0 + 0.063 * phi) * (18.9 * std::pow(h, 1.5) + 0.67 * b * h) +
                             1.55 * h * (1.0 + 1.2 * t / b) * b * b / std::sqrt(hull.length);
    return 1e3 * (at_rest + per_speed * ice.speed);
}

}  // namespace ice
