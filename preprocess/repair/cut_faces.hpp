// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// A mesh whose triangles meet along common edges and corners only.
struct CutMesh {
    TriangleMesh mesh;                 ///< pieces take the place of their triangle, same side out
    std::vector<std::int32_t> source;  ///< of each triangle: the one it is a piece of
};

/// Cuts triangles where they cross or touch others: each is triangulated with its intersections
/// with the others as edges, computed exactly (CGAL, constrained Delaunay in the triangle's plane)
/// and rounded to doubles at the end, equal points to equal bits. All other triangles and all
/// vertices stay. After rounding, pieces may cross again by some 1e-16 of the mesh's size. A mesh
/// without boundary as a chain stays so: neighbours are cut at the same points.
/// @param pairs  all that cross (find_self_intersections)
/// @return nothing where CGAL gives up. Cost about 0.2 ms per pair, shared among the threads.
std::optional<CutMesh> cut_faces(const TriangleMesh& mesh,
                                 const std::vector<std::pair<std::size_t, std::size_t>>& pairs);

}  // namespace ice
