// SPDX-License-Identifier: GPL-3.0-or-later
/// Drag in water that moves: docs/method.md, section 6.
#pragma once

#include <functional>

#include "solver/water/drag.hpp"

namespace ice {

/// Force and moment, and the power that drag dissipates.
struct RelativeDrag : WaterLoad {
    double loss = 0.0;  ///< -int u . dF >= 0 [W], D of (25): the water receives the rest of
                        ///< -(F . v + T . w)
};

/// panel_drag() with the velocity relative to water that moves, u = v + w x r - v_w, linear
/// over the quarters of each triangle that its edges' middles make, exactly:
///
///     F = -1/2 rho_w C_d int max(0, n . u) u dA,   T = int r x dF
///
/// Quarters, because a flow around a bow turns within a floe's length: with whole triangles the
/// resistance in a pre-sawn channel is 2 % higher, with sixteenths 1 % lower.
/// (equations (24) and (25)). In water at rest it is panel_drag() up to rounding. Zero for a body
/// above the water.
/// @param motion         velocities over ground here, not relative to the water
/// @param water          the water's velocity [m/s] at a point of the body [m], both in body axes
/// @param coefficient    C_d [-]
/// @param water_density  rho_w [kg/m3]
/// @pre the shape is a floe's: its edges are known
RelativeDrag relative_drag(const Shape& shape, const Motion& motion,
                           const std::function<Vec3(const Vec3&)>& water, double coefficient,
                           double water_density);

}  // namespace ice
