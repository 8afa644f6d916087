// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// Connected parts of a mesh: triangles that share an edge with exactly one other triangle belong
/// together; edges of three and more triangles join nothing.
struct Parts {
    std::vector<std::int32_t> of_triangle;  ///< T part numbers, in the order of first triangles
    std::int32_t count = 0;                 ///< of the parts
};

/// Cost O(T). @pre the mesh is welded
Parts find_parts(const TriangleMesh& mesh);

/// [count] signed volume of each part [m3] about one point of its own; of an open part without
/// meaning.
std::vector<double> part_volumes(const TriangleMesh& mesh, const Parts& parts);

}  // namespace ice
