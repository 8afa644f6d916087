// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// The edges of a mesh, each once: triangles that share one share its middle.
struct MeshEdges {
    std::vector<Vec3> middle;  ///< [m]
    /// By triangle: the edge behind each corner, a row of `middle`.
    std::vector<std::array<std::int32_t, 3>> of_triangle;
};

/// In the order of the triangles; none for no triangles. @pre corners are vertices of the mesh
MeshEdges find_edges(const TriangleMesh& mesh);

}  // namespace ice
