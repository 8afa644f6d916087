// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// Triangles over a closed walk, in its order of corners: the surface with the smallest largest
/// angle to itself and to its neighbours, then the smallest area (Liepa, SGP 2003; CGAL).
/// @param points  n corners
/// @param across  n points: the far corner of the neighbouring triangle along the edge k -> k + 1
/// @return triples of corner numbers; empty where CGAL finds none
std::vector<std::array<std::int32_t, 3>> fill_loop(const std::vector<Vec3>& points,
                                                   const std::vector<Vec3>& across);

/// Triangles over a closed walk that are Delaunay in plan (x, y), as a deck is plated: across, from
/// side to side, so that it follows a sheer line. Empty where the walk crosses itself in plan.
std::vector<std::array<std::int32_t, 3>> fill_loop_in_plan(const std::vector<Vec3>& points);

}  // namespace ice
