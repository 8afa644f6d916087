// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// An edge of a mesh with the triangles that meet there.
struct MeshEdge {
    std::int32_t a, b;                              ///< vertices, a < b
    std::int32_t count = 0;                         ///< triangles along it
    std::int32_t forwards = 0;                      ///< triangles among them that run from a to b
    std::array<std::int32_t, 2> triangles{-1, -1};  ///< the first two, in triangle order

    /// Two triangles that face the same side.
    bool regular() const { return count == 2 && forwards == 1; }
};

/// All edges, ordered by (a, b); none of an empty mesh. A triangle with two equal corners has an
/// edge a = b. Cost O(T log T).
std::vector<MeshEdge> edge_table(const TriangleMesh& mesh);

}  // namespace ice
