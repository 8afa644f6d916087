// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/clean/find_parts.hpp"

#include <numeric>

#include "common/geometry/edge_table.hpp"

namespace ice {

Parts find_parts(const TriangleMesh& mesh) {
    // union-find with halved paths; the smallest triangle number represents a part
    std::vector<std::int32_t> parent(mesh.triangles.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](std::int32_t t) {
        while (parent[static_cast<std::size_t>(t)] != t) {
            auto& up = parent[static_cast<std::size_t>(t)];
            up = parent[static_cast<std::size_t>(up)];
            t = up;
        }
        return t;
    };
    for (const MeshEdge& edge : edge_table(mesh)) {
        // parts that only share an edge with others stay apart
        if (edge.count != 2) continue;
        const std::int32_t a = root(edge.triangles[0]), b = root(edge.triangles[1]);
        parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    }
    Parts parts;
    parts.of_triangle.resize(parent.size());
    for (std::size_t t = 0; t < parent.size(); ++t) {
        // the root is the smallest number of its part, so that it has its number already
        const std::int32_t first = root(static_cast<std::int32_t>(t));
        parts.of_triangle[t] = first == static_cast<std::int32_t>(t)
                                   ? parts.count++
                                   : parts.of_triangle[static_cast<std::size_t>(first)];
    }
    return parts;
}

std::vector<double> part_volumes(const TriangleMesh& mesh, const Parts& parts) {
    std::vector<double> volumes(static_cast<std::size_t>(parts.count), 0.0);
    std::vector<std::int32_t> first(volumes.size(), -1);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto part = static_cast<std::size_t>(parts.of_triangle[t]);
        if (first[part] < 0) first[part] = static_cast<std::int32_t>(t);
        // the origin in the part itself: volumes of parts far away keep their digits
        const Vec3 o = mesh.corner(static_cast<std::size_t>(first[part]), 0);
        const Vec3 a = mesh.corner(t, 0) - o, b = mesh.corner(t, 1) - o, c = mesh.corner(t, 2) - o;
        volumes[part] += a.dot(b.cross(c)) / 6.0;
    }
    return volumes;
}

}  // namespace ice
