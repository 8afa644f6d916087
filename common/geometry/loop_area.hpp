// SPDX-License-Identifier: GPL-3.0-or-later
/// Polygons in a plane.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace ice {

using Vec2 = Eigen::Vector2d;

/// Corners in order, anticlockwise around the area, without repeating the first [m].
using Loop = std::vector<Vec2>;

/// Area inside [m2]; negative for clockwise loops, 0 for fewer than three corners. A loop that
/// crosses itself gives the sum of signed parts.
double area_of(const Loop& loop);

/// Centroid of the area inside [m]. @pre the area is not zero
Vec2 centroid_of(const Loop& loop);

/// Length all around [m]; 0 for no corners, twice the distance for two.
double length_of(const Loop& loop);

}  // namespace ice
