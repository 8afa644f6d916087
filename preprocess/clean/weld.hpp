// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// Counts of weld(), for the report.
struct WeldCounts {
    std::int64_t equal_vertices = 0;        ///< merged: the same point written several times
    std::int64_t near_vertices = 0;         ///< merged: within the tolerance
    std::int64_t degenerate_triangles = 0;  ///< dropped: two equal corners after merging
    std::int64_t duplicate_triangles = 0;   ///< dropped: same three corners, same side
};

/// Merges equal vertices; then, only while edges stay open, the vertices of open edges within 1e-6
/// of the mesh's diagonal, and at last within 1e-5 (cracks between parts exported one by one). A
/// mesh that is closed already keeps every coordinate.
///
/// Triangles that collapse or repeat are dropped, unused vertices go. The first of merged vertices
/// keeps its position, so the result depends on nothing but the order in the file. Cost O(V + T).
WeldCounts weld(TriangleMesh& mesh);

/// Merges vertices near each other, and drops triangles that collapse or repeat.
/// @param reach  [V] per vertex [m]; 0: it stays   @return count of vertices merged
std::int64_t merge_near(TriangleMesh& mesh, const std::vector<double>& reach, WeldCounts& counts);

}  // namespace ice
