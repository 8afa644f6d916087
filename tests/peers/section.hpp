// SPDX-License-Identifier: GPL-3.0-or-later
/// Polygons in the plane of a 2D case, taken from the closed mesh of a sphere set.
#pragma once

#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice::peers {

using Vec2 = Eigen::Vector2d;  ///< x and z of the world [m]

/// Corners of a closed polygon without repeats, counter-clockwise with x to the right and z up.
using Polygon = std::vector<Vec2>;

/// The section of a closed mesh by the plane y = 0, one corner per change of direction.
///
/// Every triangle that crosses the plane gives a segment, directed so that the solid lies to its
/// left; the segments are joined end to start.
/// @throws Error (exit code 2) when a vertex lies in the plane, or the section is not one loop.
Polygon outline_of(const TriangleMesh& mesh);

/// The polygon in the fewest convex parts whose corners are its own: cuts go from corner to corner,
/// so no edge of the outline is divided.
std::vector<Polygon> convex_parts(const Polygon& polygon);

/// The polygon whose edges lie `depth` [m] further in.
/// @pre no edge vanishes: depth is small against the edges
Polygon inset(const Polygon& polygon, double depth);

/// Corners of a polygon turned by `rotation` (about y) and moved to `position`.
Polygon place(const Polygon& polygon, const Mat3& rotation, const Vec3& position);

/// Shortest distance between two polygons [m]; 0 where they overlap.
double distance(const Polygon& a, const Polygon& b);

/// How deep two polygons overlap [m]: of the corners of one that lie inside the other, the largest
/// distance to the other's boundary; 0 where there are none.
double overlap_depth(const Polygon& a, const Polygon& b);

/// Is a point inside, the boundary not counted as such?
bool contains(const Polygon& polygon, const Vec2& point);

}  // namespace ice::peers
