// SPDX-License-Identifier: GPL-3.0-or-later
/// Polygons in a plane: corners in order, without repeating the first.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace ice {

/// Area inside [m2]; negative for clockwise loops, 0 for fewer than three corners. A loop that
/// crosses itself gives the sum of signed parts. @param loop  C corners [m]
double area_of(const std::vector<Eigen::Vector2d>& loop);

/// Centroid of the area inside [m]. @pre the area is not zero
Eigen::Vector2d centroid_of(const std::vector<Eigen::Vector2d>& loop);

}  // namespace ice
