// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/bending/ice_plate.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ice {

namespace {

constexpr double kPi = std::numbers::pi;
// A straight edge breaks into wedges of 36 degrees: five [-] (Nevel, as later papers print it).
// More wedges are narrower and carry less in all: n tan(pi / (2 n)) falls from 1.62 towards 1.57.
constexpr double kWedgesOnStraightEdge = 5.0;

// Of a beam on water, per length [1/m].
double lambda_of(const IcePlate& p) {
    return std::pow(3.0 * p.water_weight / (p.elastic_modulus * std::pow(p.thickness, 3)), 0.25);
}

double strength_of(const IcePlate& p) { return p.flexural_strength * p.thickness * p.thickness; }

}  // namespace

double characteristic_length(const IcePlate& p) {
    // bending stiffness of the plate, D = E h^3 / (12 (1 - nu^2)); l = (D / (rho_w g))^(1/4)
    const double stiffness = p.elastic_modulus * std::pow(p.thickness, 3) /
                             (12.0 * (1.0 - p.poisson_ratio * p.poisson_ratio));
    return std::pow(stiffness / p.water_weight, 0.25);
}

double beam_breaking_load(const IcePlate& p) {
    // (28): a semi-infinite beam with the load F at its end has the bending moment F / lambda
    // exp(-lambda x) sin(lambda x), which is largest at lambda x = pi / 4.
    return std::exp(0.25 * kPi) / (6.0 * std::sin(0.25 * kPi)) * strength_of(p) * lambda_of(p);
}

double beam_breaking_length(const IcePlate& p) { return 0.25 * kPi / lambda_of(p); }

double nevel_bracket(double ratio) { return 1.05 + 2.0 * ratio + 0.5 * ratio * ratio * ratio; }

double wedge_breaking_load(const IcePlate& p, double angle, double load_length) {
    // a straight edge is five wedges whatever the rounding of its angle
    const double wedges =
        std::max(1.0, std::ceil(kWedgesOnStraightEdge * angle / kPi * (1.0 - 1e-12)));
    return wedges * std::tan(0.5 * angle / wedges) / 3.0 * strength_of(p) *
           nevel_bracket(load_length / characteristic_length(p));
}

double kashtelyan_breaking_load(const IcePlate& p, double angle) {
    return (angle / kPi) * (angle / kPi) * strength_of(p);
}

}  // namespace ice
