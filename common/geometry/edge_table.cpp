// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/geometry/edge_table.hpp"

#include <algorithm>

namespace ice {

namespace {

// A side of a triangle, filed under its smaller vertex.
struct Side {
    std::int32_t b;  // the larger vertex
    std::int32_t triangle;
    bool forwards;
};

// Sides filed by their smaller vertex: those of vertex v are [first[v], first[v + 1]). Counting
// into place is several times faster than sorting all sides at once.
std::vector<Side> file_sides(const TriangleMesh& mesh, std::vector<std::size_t>& first) {
    first.assign(mesh.vertices.size() + 1, 0);
    for (const auto& t : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k)
            ++first[static_cast<std::size_t>(std::min(t[k], t[(k + 1) % 3])) + 1];
    // counts to places: a running sum
    for (std::size_t v = 1; v < first.size(); ++v) first[v] += first[v - 1];
    std::vector<std::size_t> next(first.begin(), first.end() - 1);
    std::vector<Side> sides(3 * mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::int32_t from = mesh.triangles[t][k], to = mesh.triangles[t][(k + 1) % 3];
            sides[next[static_cast<std::size_t>(std::min(from, to))]++] = {
                std::max(from, to), static_cast<std::int32_t>(t), from < to};
        }
    return sides;
}

}  // namespace

std::vector<MeshEdge> edge_table(const TriangleMesh& mesh) {
    std::vector<std::size_t> first;
    std::vector<Side> sides = file_sides(mesh, first);
    std::vector<MeshEdge> edges;
    edges.reserve(sides.size() / 2);
    // Sides are filed under their smaller vertex, so each list to sort is short. The other vertex
    // is the first key: it makes equal edges neighbours. The triangle is the second: it keeps the
    // order of the mesh.
    for (std::size_t v = 0; v + 1 < first.size(); ++v) {
        const auto begin = sides.begin() + static_cast<std::ptrdiff_t>(first[v]);
        const auto end = sides.begin() + static_cast<std::ptrdiff_t>(first[v + 1]);
        std::sort(begin, end, [](const Side& l, const Side& r) {
            return l.b < r.b || (l.b == r.b && l.triangle < r.triangle);
        });
        for (auto side = begin; side != end; ++side) {
            if (side == begin || side->b != (side - 1)->b)
                edges.push_back({static_cast<std::int32_t>(v), side->b});
            MeshEdge& edge = edges.back();
            // only the first two: an edge with more is crowded, and its caller needs the count
            // alone
            if (edge.count < 2)
                edge.triangles[static_cast<std::size_t>(edge.count)] = side->triangle;
            ++edge.count;
            edge.forwards += side->forwards ? 1 : 0;
        }
    }
    return edges;
}

}  // namespace ice
