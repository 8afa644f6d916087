// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "common/geometry/surface_tree.hpp"
#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// Moves vertices of a contour onto the creases and corners of its source, which the contour's
/// cells cut off. Where the ends of an edge lie on faces over 30 degrees apart, one end moves to
/// the crease of these faces, or the edge is turned, so that edges of the contour follow the crease
/// (as in Kobbelt et al., Feature sensitive surface extraction, SIGGRAPH 2001, but with vertices
/// moved instead of added; recalled, not looked up). A vertex stays where the move is longer than
/// 1.5 cells, ends off the surface, or leaves a triangle that is folded or crosses another.
/// @param source  the surface; the contour's vertices lie on it but where voids were filled
/// @param cell    edge of the contour's cubes [m]
/// @return        the count of vertices moved; 0 and the contour as it was if too many are bad
std::int64_t sharpen_contour(TriangleMesh& contour, const SurfaceTree& source, double cell);

}  // namespace ice
