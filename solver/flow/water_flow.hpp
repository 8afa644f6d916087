// SPDX-License-Identifier: GPL-3.0-or-later
/// How the water moves, anywhere and now.
#pragma once

#include "solver/flow/look_up_flow.hpp"

namespace ice {

/// An even current c, and the flow that the ship makes in it. With U the ship's speed over ground
/// along x and grad phi the flow in the table, at the place in the ship's frame, the velocity of
/// the water is
///
///     v_w(x, t) = c + (U(t) - c_x) grad phi(x - x_ship(t))
///
/// (equation (24)).
/// The table has no flow of a current athwart the ship: there the water passes through the hull.
struct WaterFlow {
    FlowGrid grid;
    Vec3 current = Vec3::Zero();  ///< along x and y [m/s]
    Vec3 ship = Vec3::Zero();     ///< place of the hull mesh's origin; its z does not matter [m]
    double speed = 0.0;           ///< of the ship, less the current's [m/s]
    bool presses = false;         ///< its dynamic pressure acts on floes

    /// Takes the ship's place [m] and velocity [m/s] for a step.
    void follow(const Vec3& place, const Vec3& velocity) {
        ship = place;
        speed = velocity.x() - current.x();
    }
    /// Is there more than an even current?
    bool flows() const { return !grid.empty() && speed != 0.0; }

    /// Whether the ship may move the water within a sphere. @param centre, radius  [m]
    bool reaches(const Vec3& centre, double radius) const {
        if (!flows()) return false;
        const double low_y =
            grid.symmetric ? -(grid.origin.y() + grid.last_y / grid.per_spacing) : grid.origin.y();
        const double x = centre.x() - ship.x() - grid.origin.x(), y = centre.y() - ship.y() - low_y;
        const double wide = grid.symmetric ? -2.0 * low_y : grid.last_y / grid.per_spacing;
        return x > -radius && x < grid.last_x / grid.per_spacing + radius &&
               (grid.stride_y == 0 || (y > -radius && y < wide + radius)) && centre.z() < radius &&
               centre.z() > grid.origin.z() - radius;
    }
};

namespace reference {
/// v_w of (24) at a place x [m], world axes [m/s].
inline Vec3 water_at(const WaterFlow& water, const Vec3& x) {
    if (!water.flows()) return water.current;
    const Vec3 v =
        look_up_flow(water.grid, Vec3(x.x() - water.ship.x(), x.y() - water.ship.y(), x.z()))
            .velocity;
    return Vec3(water.current.x() + water.speed * v.x(), water.current.y() + water.speed * v.y(),
                water.current.z() + water.speed * v.z());
}

/// Dynamic pressure at a place, over the water's density [m2/s2]: Bernoulli's for a ship at
/// constant speed, p / rho = (U - c_x) (v_w - c)_x - |v_w - c|^2 / 2 (equation (P1)), 0 far away.
inline double pressure_at(const WaterFlow& water, const Vec3& x) {
    if (!water.flows()) return 0.0;
    const Vec3 g =
        look_up_flow(water.grid, Vec3(x.x() - water.ship.x(), x.y() - water.ship.y(), x.z()))
            .velocity;
    const double square = (g.x() * g.x() + g.y() * g.y()) + g.z() * g.z();
    return (water.speed * water.speed) * (g.x() - 0.5 * square);
}
}  // namespace reference

}  // namespace ice
