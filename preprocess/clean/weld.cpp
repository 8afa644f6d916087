// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/clean/weld.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "common/geometry/edge_table.hpp"
#include "common/geometry/find_equal.hpp"
#include "preprocess/clean/keep_triangles.hpp"

namespace ice {

namespace {

// Of the diagonal: rounding of single-precision files; cracks between parts that were exported one
// by one. Half a millimetre on a 50 m ship, far below a contact sphere's radius. Larger tolerances
// would merge vertices of fine details; wider cracks are stitched (stitch_open_edges()).
constexpr double kTolerances[] = {1e-6, 1e-5};

// For each vertex the first that is within both ones' reach; itself where it has none.
std::vector<std::int32_t> find_near(const std::vector<Vec3>& vertices,
                                    const std::vector<double>& reach) {
    Eigen::AlignedBox3d box;
    for (const Vec3& v : vertices) box.extend(v);
    const double tolerance = std::max(*std::max_element(reach.begin(), reach.end()), 1e-300);
    // cells of twice the tolerance: near vertices lie in the same one or on its nearer side
    const auto cell_of = [&](const Vec3& v, Key& side) -> Key {
        Key cell;
        for (int d = 0; d < 3; ++d) {
            const double at = (v[d] - box.min()[d]) / (2.0 * tolerance) + 1.0;
            cell[static_cast<std::size_t>(d)] = static_cast<std::uint64_t>(at);
            side[static_cast<std::size_t>(d)] =
                at - std::floor(at) < 0.5 ? ~std::uint64_t{0} : std::uint64_t{1};
        }
        return cell;
    };
    std::unordered_map<Key, std::int32_t, HashKey> cells;  // the last vertex that came into one
    cells.reserve(vertices.size());
    std::vector<std::int32_t> before(vertices.size(), -1);  // the one that came before it
    std::vector<std::int32_t> representative(vertices.size());
    for (std::size_t k = 0; k < vertices.size(); ++k) {
        auto found = static_cast<std::int32_t>(k);
        representative[k] = found;
        if (reach[k] <= 0.0) continue;
        Key side;
        const Key at = cell_of(vertices[k], side);
        // eight cells: its own and those on its nearer sides
        for (std::uint64_t n = 0; n < 8; ++n) {
            const auto near = cells.find({at[0] + (n & 1) * side[0], at[1] + (n >> 1 & 1) * side[1],
                                          at[2] + (n >> 2) * side[2]});
            if (near == cells.end()) continue;
            for (std::int32_t other = near->second; other >= 0;
                 other = before[static_cast<std::size_t>(other)])
                if ((vertices[static_cast<std::size_t>(other)] - vertices[k]).norm() <=
                    std::min(reach[k], reach[static_cast<std::size_t>(other)]))
                    found = std::min(found, other);
        }
        representative[k] = found;
        if (found != static_cast<std::int32_t>(k)) continue;
        const auto [head, fresh] = cells.try_emplace(at, found);
        if (!fresh) before[k] = std::exchange(head->second, found);
    }
    return representative;
}

// Gives corners their representatives, drops triangles that collapse or repeat. Returns the count
// of vertices merged.
std::int64_t merge(TriangleMesh& mesh, const std::vector<std::int32_t>& representative,
                   WeldCounts& counts) {
    std::vector<std::uint8_t> keep(mesh.triangles.size(), 1);
    // corners get their representatives; triangles that lose a corner go
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        auto& corner = mesh.triangles[t];
        for (std::int32_t& v : corner) v = representative[static_cast<std::size_t>(v)];
        if (corner[0] != corner[1] && corner[1] != corner[2] && corner[2] != corner[0]) continue;
        ++counts.degenerate_triangles;
        keep[t] = 0;
    }
    // the same triangle whichever corner comes first; its other side is another triangle
    const auto first = find_first(mesh.triangles.size(), [&](std::size_t t) -> Key {
        std::array<std::int32_t, 3> turned = mesh.triangles[t];
        std::rotate(turned.begin(), std::min_element(turned.begin(), turned.end()), turned.end());
        Key key;
        std::transform(turned.begin(), turned.end(), key.begin(),
                       [](std::int32_t v) { return static_cast<std::uint64_t>(v); });
        return key;
    });
    for (std::size_t t = 0; t < first.size(); ++t) {
        if (!keep[t] || first[t] == static_cast<std::int32_t>(t)) continue;
        ++counts.duplicate_triangles;
        keep[t] = 0;
    }
    std::int64_t merged = 0;
    for (std::size_t k = 0; k < representative.size(); ++k)
        merged += representative[k] != static_cast<std::int32_t>(k);
    keep_triangles(mesh, keep);
    return merged;
}

}  // namespace

std::int64_t merge_near(TriangleMesh& mesh, const std::vector<double>& reach, WeldCounts& counts) {
    return merge(mesh, find_near(mesh.vertices, reach), counts);
}

WeldCounts weld(TriangleMesh& mesh) {
    WeldCounts counts;
    counts.equal_vertices = merge(mesh, find_equal_vertices(mesh.vertices), counts);
    Eigen::AlignedBox3d box;
    for (const Vec3& v : mesh.vertices) box.extend(v);
    // Only vertices of open edges are merged: inside a closed surface nothing is too near.
    for (const double tolerance : kTolerances) {
        std::vector<double> reach(mesh.vertices.size(), 0.0);
        bool open = false;
        for (const MeshEdge& edge : edge_table(mesh)) {
            if (edge.count != 1) continue;
            open = true;
            reach[static_cast<std::size_t>(edge.a)] = reach[static_cast<std::size_t>(edge.b)] =
                tolerance * box.diagonal().norm();
        }
        if (!open) break;
        counts.near_vertices += merge_near(mesh, reach, counts);
    }
    return counts;
}

}  // namespace ice
