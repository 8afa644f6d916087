// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/shape/mesh_edges.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "common/base/assert.hpp"

namespace ice {

// An edge by its two vertices, the lower number first: both of its triangles find the same one.
MeshEdges find_edges(const TriangleMesh& mesh) {
    MeshEdges out;
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> known;
    for (const auto& corners : mesh.triangles) {
        auto& edges = out.of_triangle.emplace_back();
        // an edge has two triangles: the second one finds the middle of the first
        for (std::size_t k = 0; k < 3; ++k) {
            const std::int32_t a = corners[k], b = corners[(k + 1) % 3];
            ICE_ASSERT(a >= 0 && a < std::ssize(mesh.vertices));
            const auto [edge, fresh] =
                known.try_emplace(std::minmax(a, b), static_cast<std::int32_t>(out.middle.size()));
            if (fresh)
                out.middle.emplace_back(0.5 * (mesh.vertices[static_cast<std::size_t>(a)] +
                                               mesh.vertices[static_cast<std::size_t>(b)]));
            edges[k] = edge->second;
        }
    }
    return out;
}

}  // namespace ice
