// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/clean/drop_repeats.hpp"

#include <algorithm>
#include <map>

#include "common/geometry/edge_table.hpp"
#include "preprocess/clean/keep_triangles.hpp"

namespace ice {

namespace {

using Triple = std::array<std::int32_t, 3>;

Triple sorted(Triple t) {
    std::sort(t.begin(), t.end());
    return t;
}

// Triangles by their corners, for those on an edge of more than two only: no others can repeat.
std::map<Triple, std::vector<std::size_t>> group_by_corners(const TriangleMesh& mesh,
                                                            const std::vector<MeshEdge>& edges) {
    // Copies share all three edges, so that these have three triangles or more, or two that do not
    // agree, or two that are copies of each other (a closed surface of two sides).
    std::vector<std::uint8_t> crowded(mesh.vertices.size(), 0);
    for (const MeshEdge& edge : edges)
        if (edge.count > 2 || (edge.count == 2 && !edge.regular()))
            crowded[static_cast<std::size_t>(edge.a)] = crowded[static_cast<std::size_t>(edge.b)] =
                1;
        else if (edge.count == 2 &&
                 sorted(mesh.triangles[static_cast<std::size_t>(edge.triangles[0])]) ==
                     sorted(mesh.triangles[static_cast<std::size_t>(edge.triangles[1])]))
            crowded[static_cast<std::size_t>(edge.a)] = crowded[static_cast<std::size_t>(edge.b)] =
                1;
    std::map<Triple, std::vector<std::size_t>> groups;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Triple& c = mesh.triangles[t];
        int marked = 0;
        for (const std::int32_t v : c) marked += crowded[static_cast<std::size_t>(v)];
        if (marked >= 2) groups[sorted(c)].push_back(t);
    }
    return groups;
}

}  // namespace

RepeatCounts drop_repeats(TriangleMesh& mesh) {
    RepeatCounts counts;
    const auto edges = edge_table(mesh);
    const auto groups = group_by_corners(mesh, edges);
    // of each edge: triangles that are alone on their corners, and groups of several
    std::map<std::pair<std::int32_t, std::int32_t>, int> alone;
    std::vector<std::uint8_t> keep(mesh.triangles.size(), 1);
    const auto edge_count = [&](std::int32_t a, std::int32_t b) {
        const auto at = std::lower_bound(
            edges.begin(), edges.end(), std::pair(a, b),
            [](const MeshEdge& e, const auto& key) { return std::pair(e.a, e.b) < key; });
        return at->count;
    };
    for (const auto& [corner, members] : groups) {
        if (members.size() < 2) continue;
        for (const auto& [a, b] : {std::pair(corner[0], corner[1]), std::pair(corner[1], corner[2]),
                                   std::pair(corner[0], corner[2])}) {
            auto [at, fresh] = alone.try_emplace({a, b}, 0);
            if (fresh) at->second = edge_count(a, b);
            at->second -= static_cast<int>(members.size()) - 1;
        }
    }
    // `alone` now counts each group once. Of copies one stays where the edges' triangles are
    // then even in number, else none: two copies of a wall without thickness enclose nothing.
    for (const auto& [corner, members] : groups) {
        if (members.size() < 2) continue;
        int needed = 0;
        for (const auto& [a, b] : {std::pair(corner[0], corner[1]), std::pair(corner[1], corner[2]),
                                   std::pair(corner[0], corner[2])})
            if (alone.at({a, b}) > 1) needed += alone.at({a, b}) % 2 == 0 ? 1 : -1;
        const bool one_stays = needed >= 0;
        for (std::size_t k = one_stays ? 1 : 0; k < members.size(); ++k) keep[members[k]] = 0;
        const auto dropped = static_cast<std::int64_t>(members.size()) - (one_stays ? 1 : 0);
        (one_stays ? counts.copies : counts.walls) += dropped;
    }
    if (counts.copies + counts.walls > 0) keep_triangles(mesh, keep);
    return counts;
}

}  // namespace ice
