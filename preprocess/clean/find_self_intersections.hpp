// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>
#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// Pairs of triangles that cross or touch other than along a shared edge or corner, decided with
/// exact predicates (CGAL) among those whose boxes meet. Corners at the same point count as shared,
/// whatever their numbers. Each pair once, the smaller number first, in order.
/// Triangles without area cross nothing. An empty mesh gives none. Cost O(T log T + candidates).
std::vector<std::pair<std::size_t, std::size_t>> find_self_intersections(const TriangleMesh& mesh);

}  // namespace ice
