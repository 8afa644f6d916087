// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

namespace ice {

/// Corners of the convex hull of points in a plane [m], anticlockwise, without those on straight
/// sides and without repeating the first; two where the points lie on a line (of a single point
/// twice that), none for none. The order of the points does not matter. Cost: that of sorting them.
///
/// Source: Andrew, "Another efficient algorithm for convex hulls in two dimensions", Information
/// Processing Letters 9, 1979.
std::vector<Eigen::Vector2d> convex_corners(std::vector<Eigen::Vector2d> points);

}  // namespace ice
