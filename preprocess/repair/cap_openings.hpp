// SPDX-License-Identifier: GPL-3.0-or-later
/// Openings of a surface and the caps that close them.
#pragma once

#include <string>
#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// Where a cap's triangle meets the surface around the opening.
struct RimEdge {
    std::int32_t patch;      ///< triangle of the cap
    std::int32_t neighbour;  ///< triangle of the surface across the edge
    Vec3 along;              ///< [m]
    double length;           ///< [m]
};

/// Triangles over one opening: [first, first + count) of the mesh.
struct Cap {
    std::int32_t first = 0, count = 0;
    std::vector<RimEdge> rim;
    double perimeter = 0.0;  ///< [m]
};

/// Appends a cap to every opening (see opening_loops), facing as the surface around it; its region
/// is the one that has most of the rim. The mesh's boundary is then zero as a chain. Where the best
/// triangulation would use an edge that the surface has already, the cap is a fan about a new
/// vertex in the middle of the loop.
/// @pre the mesh is welded and its faces are oriented
std::vector<Cap> cap_openings(TriangleMesh& mesh);

}  // namespace ice
