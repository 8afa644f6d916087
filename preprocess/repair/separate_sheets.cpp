// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/repair/separate_sheets.hpp"

#include <algorithm>
#include <map>
#include <numeric>

#include "common/geometry/edge_table.hpp"
#include "preprocess/clean/find_parts.hpp"

namespace ice {

namespace {

using EdgeEnds = std::pair<std::int32_t, std::int32_t>;
using Pairing = std::vector<std::pair<std::int32_t, std::int32_t>>;  // triangles, two by two

std::size_t corner_of(const TriangleMesh& mesh, std::int32_t triangle, std::int32_t vertex) {
    const auto& t = mesh.triangles[static_cast<std::size_t>(triangle)];
    return static_cast<std::size_t>(std::find(t.begin(), t.end(), vertex) - t.begin());
}

// The edge table has two triangles of an edge only: of edges with more all are collected here.
std::map<EdgeEnds, std::vector<std::int32_t>> find_crowded(const TriangleMesh& mesh,
                                                           const std::vector<MeshEdge>& edges) {
    std::map<EdgeEnds, std::vector<std::int32_t>> crowded;
    for (const MeshEdge& edge : edges)
        // a place in the map; the triangles follow
        if (edge.count > 2) crowded[{edge.a, edge.b}];
    if (crowded.empty()) return crowded;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [a, b] = std::minmax(mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]);
            const auto at = crowded.find({a, b});
            if (at != crowded.end()) at->second.push_back(static_cast<std::int32_t>(t));
        }
    return crowded;
}

Pairing pair_up(const TriangleMesh& mesh, const Parts& parts, const EdgeEnds& edge,
                const std::vector<std::int32_t>& triangles) {
    const Vec3 a = mesh.vertices[static_cast<std::size_t>(edge.first)];
    const Vec3 axis = (mesh.vertices[static_cast<std::size_t>(edge.second)] - a).normalized();
    struct Choice {
        bool other_part;
        double turn;  // 1 - cosine of the angle between the two
        std::int32_t s, t;
    };
    // Unit vector from the edge into the triangle, at right angles to the edge: the cosine of two
    // of them is that of the angle between the triangles.
    const auto away = [&](std::int32_t t) {
        const std::size_t k = corner_of(mesh, t, edge.first), l = corner_of(mesh, t, edge.second);
        const Vec3 d = mesh.corner(static_cast<std::size_t>(t), static_cast<int>(3 - k - l)) - a;
        return Vec3((d - axis * axis.dot(d)).normalized());
    };
    // Neighbours in a surface run through their common edge in opposite directions.
    const auto forwards = [&](std::int32_t t) {
        return (corner_of(mesh, t, edge.first) + 1) % 3 == corner_of(mesh, t, edge.second);
    };
    // a triangle that runs forwards pairs with one that runs backwards: of the same part, and
    // with the smallest angle between them
    std::vector<Choice> choices;
    for (const std::int32_t s : triangles)
        for (const std::int32_t t : triangles)
            if (forwards(s) && !forwards(t))
                choices.push_back({parts.of_triangle[static_cast<std::size_t>(s)] !=
                                       parts.of_triangle[static_cast<std::size_t>(t)],
                                   1.0 - away(s).dot(away(t)), s, t});
    std::stable_sort(choices.begin(), choices.end(), [](const Choice& l, const Choice& r) {
        return std::pair(l.other_part, l.turn) < std::pair(r.other_part, r.turn);
    });
    Pairing out;
    std::vector<std::int32_t> used;
    const auto taken = [&](std::int32_t t) {
        return std::find(used.begin(), used.end(), t) != used.end();
    };
    // greedily, from the best pair on
    for (const Choice& c : choices) {
        if (taken(c.s) || taken(c.t)) continue;
        out.emplace_back(c.s, c.t);
        used.insert(used.end(), {c.s, c.t});
    }
    return out;
}

// Corners that stay one vertex, as sets.
class Corners {
public:
    explicit Corners(const TriangleMesh& mesh) : mesh_(mesh), parent_(3 * mesh.triangles.size()) {
        std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    }
    void join(std::int32_t s, std::int32_t t, std::int32_t vertex) {
        const std::size_t a = root(3 * static_cast<std::size_t>(s) + corner_of(mesh_, s, vertex));
        const std::size_t b = root(3 * static_cast<std::size_t>(t) + corner_of(mesh_, t, vertex));
        parent_[std::max(a, b)] = std::min(a, b);
    }
    std::size_t root(std::size_t k) {
        while (parent_[k] != k) k = parent_[k] = parent_[parent_[k]];
        return k;
    }

private:
    const TriangleMesh& mesh_;
    std::vector<std::size_t> parent_;
};

}  // namespace

std::int64_t separate_sheets(TriangleMesh& mesh) {
    const auto edges = edge_table(mesh);
    const auto crowded = find_crowded(mesh, edges);
    if (crowded.empty()) return 0;
    const Parts parts = find_parts(mesh);
    Corners corners(mesh);
    // Corners of triangles are joined across regular edges, and across crowded ones where two
    // triangles form one sheet. Sets of joined corners then are the vertices.
    const auto join = [&](const EdgeEnds& edge, std::int32_t s, std::int32_t t) {
        corners.join(s, t, edge.first);
        corners.join(s, t, edge.second);
    };
    for (const MeshEdge& edge : edges)
        // Corners across a regular edge are the same two vertices. A vertex at which two sheets
        // only touch is in two sets then, and becomes two vertices.
        if (edge.count == 2) join({edge.a, edge.b}, edge.triangles[0], edge.triangles[1]);
    for (const auto& [edge, triangles] : crowded)
        for (const auto& [s, t] : pair_up(mesh, parts, edge, triangles)) join(edge, s, t);

    // the first set of corners at a vertex keeps it, the others get copies
    constexpr std::size_t kNone = ~std::size_t{0};
    std::vector<std::size_t> owner(mesh.vertices.size(), kNone);
    std::vector<std::int32_t> copy(3 * mesh.triangles.size(), -1);
    for (std::size_t k = 0; k < copy.size(); ++k) {
        std::int32_t& v = mesh.triangles[k / 3][k % 3];
        const std::size_t root = corners.root(k);
        if (copy[root] < 0) {
            copy[root] = v;
            if (owner[static_cast<std::size_t>(v)] != kNone) {
                copy[root] = static_cast<std::int32_t>(mesh.vertices.size());
                mesh.vertices.push_back(Vec3(mesh.vertices[static_cast<std::size_t>(v)]));
            } else {
                owner[static_cast<std::size_t>(v)] = root;
            }
        }
        v = copy[root];
    }
    return static_cast<std::int64_t>(crowded.size());
}

}  // namespace ice
