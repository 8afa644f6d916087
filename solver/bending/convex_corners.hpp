// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

namespace ice {

/// Corners of the convex hull of points in a plane, anticlockwise, without those on straight sides;
/// fewer than three where the points lie on a line.
///
/// Source: Andrew, "Another efficient algorithm for convex hulls in two dimensions", Information
/// Processing Letters 9, 1979.
std::vector<Eigen::Vector2d> convex_corners(std::vector<Eigen::Vector2d> points);

}  // namespace ice
