// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/clean/edge_table.hpp"

#include <algorithm>

namespace ice {

namespace {

struct Side {
    std::uint64_t key;  // a in the high, b in the low half
    std::int32_t triangle;
    bool forwards;
};

}  // namespace

std::vector<MeshEdge> edge_table(const TriangleMesh& mesh) {
    std::vector<Side> sides;
    sides.reserve(3 * mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::int32_t from = mesh.triangles[t][k], to = mesh.triangles[t][(k + 1) % 3];
            const auto a = static_cast<std::uint64_t>(std::min(from, to));
            const auto b = static_cast<std::uint64_t>(std::max(from, to));
            sides.push_back({a << 32 | b, static_cast<std::int32_t>(t), from < to});
        }
    std::sort(sides.begin(), sides.end(), [](const Side& l, const Side& r) {
        return l.key < r.key || (l.key == r.key && l.triangle < r.triangle);
    });
    std::vector<MeshEdge> edges;
    edges.reserve(sides.size() / 2);
    for (std::size_t k = 0; k < sides.size(); ++k) {
        if (k == 0 || sides[k].key != sides[k - 1].key)
            edges.push_back({static_cast<std::int32_t>(sides[k].key >> 32),
                             static_cast<std::int32_t>(sides[k].key & 0xffffffffu)});
        MeshEdge& edge = edges.back();
        if (edge.count < 2)
            edge.triangles[static_cast<std::size_t>(edge.count)] = sides[k].triangle;
        ++edge.count;
        edge.forwards += sides[k].forwards ? 1 : 0;
    }
    return edges;
}

}  // namespace ice
