// SPDX-License-Identifier: GPL-3.0-or-later
/// Pressure of moving water on a body: docs/method.md, section 6.
#pragma once

#include <functional>

#include "solver/water/drag.hpp"

namespace ice {

/// Force and moment of a pressure on the wetted surface, linear over the quarters of each triangle
/// that its edges' middles make, exactly:
///
///     F = -int p n dA,   T = -int p r x n dA
///
/// (equation (P1)). Zero for a body above the water.
/// @param rotation  body to world
/// @param height    z of the body origin [m]
/// @param pressure  [Pa] at a point of the body [m], body axes; that of water at rest is
///                  buoyancy's and left out
/// @pre the shape is a floe's: its edges are known
WaterLoad pressure_load(const Shape& shape, const Mat3& rotation, double height,
                        const std::function<double(const Vec3&)>& pressure);

}  // namespace ice
