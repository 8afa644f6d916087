// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/formulas/lindqvist.hpp"

#include <cmath>

namespace ice {

double lindqvist_submersion(const HullDimensions& hull, const IceConditions& ice) {
    const double sin_phi = std::sin(hull.stem_angle), cos_phi = std::cos(hull.stem_angle);
    const double tan_phi = std::tan(hull.stem_angle), tan_alpha = std::tan(hull.entrance_angle);
    const double psi = std::atan(tan_phi / std::sin(hull.entrance_angle));
    // (F1), the submersion part: the weight of the submerged ice on the ship, and the friction of
    // the ice that covers bottom and sides
    const double b = hull.breadth, t = hull.draught;
    const double covered = 0.7 * hull.length - t / tan_phi - b / (4.0 * tan_alpha) +
                           t * cos_phi * std::cos(psi) *
                               std::sqrt(1.0 / (sin_phi * sin_phi) + 1.0 / (tan_alpha * tan_alpha));
    const double weight = (ice.water_density - ice.ice_density) * ice.gravity * ice.thickness * b;
    const double at_rest = weight * (t * (b + t) / (b + 2.0 * t) + ice.friction * covered);
    return at_rest * (1.0 + 9.4 * ice.speed / std::sqrt(ice.gravity * hull.length));
}

LindqvistParts lindqvist_resistance(const HullDimensions& hull, const IceConditions& ice) {
    // (F1), term by term
    const double sin_phi = std::sin(hull.stem_angle), cos_phi = std::cos(hull.stem_angle);
    const double tan_phi = std::tan(hull.stem_angle), sin_alpha = std::sin(hull.entrance_angle);
    const double psi = std::atan(tan_phi / sin_alpha), cos_psi = std::cos(psi);
    const double h = ice.thickness, sigma = ice.flexural_strength, mu = ice.friction;
    const double nu = ice.poisson_ratio;
    // Denominator of the crushing part: at 0 friction at the stem balances the force that pushes
    // the ice down, and the ice is neither crushed nor bent.
    const double grip = 1.0 - mu * sin_phi / cos_psi;
    const double faster = 1.0 + 1.4 * ice.speed / std::sqrt(ice.gravity * h);
    LindqvistParts out;
    out.submersion = lindqvist_submersion(hull, ice);
    out.crushing = grip > 0.0
                       ? 0.5 * sigma * h * h * (tan_phi + mu * cos_phi / cos_psi) / grip * faster
                       : std::nan("");
    const double stiffness =
        ice.elastic_modulus / (12.0 * (1.0 - nu * nu) * ice.water_density * ice.gravity);
    out.bending = 27.0 / 64.0 * sigma * hull.breadth * std::pow(h, 1.5) / std::sqrt(stiffness) *
                  (std::tan(psi) + mu * cos_phi / (sin_alpha * cos_psi)) * (1.0 + 1.0 / cos_psi) *
                  faster;
    return out;
}

}  // namespace ice
