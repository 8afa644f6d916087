// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// Union of closed outward bodies that may cross each other (CGAL corefinement, exact predicates).
/// @return nothing where CGAL gives up: bodies that cross themselves, or meet in a curve that no
///         manifold has. Regions are not set.
std::optional<TriangleMesh> unite_bodies(const std::vector<TriangleMesh>& bodies);

/// Unites the parts of a mesh that cross each other; parts that cross nothing keep every
/// coordinate. Regions follow (copy_regions).
/// @param pairs  crossing triangles (find_self_intersections)
/// @param united takes the number of parts that went into unions
/// @return nothing where a part crosses itself, too many take part (40), or CGAL gives up
std::optional<TriangleMesh> unite_parts(
    const TriangleMesh& mesh, const std::vector<std::pair<std::size_t, std::size_t>>& pairs,
    std::int64_t* united);

}  // namespace ice
