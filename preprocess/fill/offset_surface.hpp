// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "preprocess/measure/surface_tree.hpp"

namespace ice {

/// Moves a point to the nearest place where a sphere of `radius` touches the surface from inside:
/// a point of the offset surface {d = radius}, in its edges and corners where faces meet.
///
/// Newton on the distances: every face nearer than the radius is a condition g . move >= radius - d
/// (g away from the foot); the smallest move that satisfies the worst of them, three directions at
/// most, is taken until all hold. Deeper points first move towards their foot.
///
/// @return nothing when the start lies outside the solid or no sphere fits there (thin parts).
///         Otherwise the distance to the surface is `radius` within 1e-9 of it.
std::optional<Vec3> settle(const SurfaceTree& tree, const Vec3& start, double radius);

/// The directions, from a settled centre, of the places where its sphere touches the surface;
/// directions within 0.01 rad of each other count once. Unit vectors, pointing outwards.
std::vector<Vec3> touch_directions(const SurfaceTree& tree, const Vec3& center, double radius);

}  // namespace ice
