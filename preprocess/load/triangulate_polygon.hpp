// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// Cuts a polygon into triangles of the same sense; returns triples of positions in `corners`.
///
/// A convex quadrilateral is cut along its shorter diagonal (the first on a tie), so that a hull's
/// two sides are cut alike and stay mirror images. Everything else loses its ears one by one,
/// concave polygons too. A polygon without area, or one that crosses itself, still gives
/// count - 2 triangles; the check of the solid finds what is wrong with them.
/// @pre at least three corners. Cost O(n^2) for n corners, O(1) for triangles and quadrilaterals.
std::vector<std::array<std::size_t, 3>> triangulate_polygon(const std::vector<Vec3>& corners);

}  // namespace ice
