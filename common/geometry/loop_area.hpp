// SPDX-License-Identifier: GPL-3.0-or-later
/// Polygons in a plane: corners in order, without repeating the first.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace ice {

/// Area inside [m2]; negative for clockwise loops.
double area_of(const std::vector<Eigen::Vector2d>& loop);

/// Centroid of the area inside. @pre the area is not zero
Eigen::Vector2d centroid_of(const std::vector<Eigen::Vector2d>& loop);

}  // namespace ice
