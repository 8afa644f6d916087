// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// The edge of an opening: a simple closed walk along open edges of the surface.
struct OpeningLoop {
    std::vector<std::int32_t> vertices;  ///< n, so that a cap in this order faces as the surface
    std::vector<std::int32_t>
        neighbours;  ///< n triangles: the one along the edge k -> k + 1, or -1
};

/// Where the boundary of the surface, taken as a chain, is not zero: along each edge the triangles
/// that run one way less edges that run the other. A cap on every loop makes the chain closed, so
/// that its winding number is a whole number everywhere, whatever is crowded or pinched.
/// Where several loops pass one vertex, each turns into the opening that it came along.
/// @pre the mesh is welded and its faces are oriented
std::vector<OpeningLoop> opening_loops(const TriangleMesh& mesh);

}  // namespace ice
