// SPDX-License-Identifier: GPL-3.0-or-later
/// Drag in water that moves: docs/method.md, section 6.
#pragma once

#include <span>

#include "solver/water/drag.hpp"

namespace ice {

/// Force and moment, and what of their work is lost.
struct RelativeDrag : WaterLoad {
    double loss = 0.0;     ///< -int u . dF >= 0 [W]: the rest of -(F . v + T . w) goes to the water
    double fastest = 0.0;  ///< largest |u| at the form's corners, wet or dry [m/s]
};

/// panel_drag() with the velocity relative to water that moves, u = v + w x r - w_water, linear
/// between the corners of each triangle; exactly, whatever the triangles:
///
///     F = -1/2 rho_w C_d int max(0, n . u) u dA,   T = int r x dF
///
/// @param water  the water's velocity at the form's vertices, body axes [m/s]
RelativeDrag relative_drag(const Shape& shape, const Motion& motion, std::span<const Vec3> water,
                           double coefficient, double water_density);

}  // namespace ice
