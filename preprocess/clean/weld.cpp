// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/clean/weld.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <unordered_map>
#include <unordered_set>

#include "preprocess/clean/edge_table.hpp"
#include "preprocess/clean/keep_triangles.hpp"

namespace ice {

namespace {

constexpr double kTolerance = 1e-6;  // of the diagonal: rounding of single-precision files

using Key = std::array<std::uint64_t, 3>;

struct HashKey {
    std::size_t operator()(const Key& key) const {
        std::uint64_t value = 0xcbf29ce484222325ull;
        for (const std::uint64_t word : key) {
            value = (value ^ word) * 0x9e3779b97f4a7c15ull;
            value ^= value >> 32;
        }
        return static_cast<std::size_t>(value);
    }
};

// For each vertex the first with the same coordinates; 0 and -0 are the same.
std::vector<std::int32_t> find_equal(const std::vector<Vec3>& vertices) {
    std::unordered_map<Key, std::int32_t, HashKey> first;
    first.reserve(vertices.size());
    std::vector<std::int32_t> representative(vertices.size());
    for (std::size_t k = 0; k < vertices.size(); ++k) {
        Key key;
        for (int d = 0; d < 3; ++d)
            key[static_cast<std::size_t>(d)] = std::bit_cast<std::uint64_t>(vertices[k][d] + 0.0);
        representative[k] = first.try_emplace(key, static_cast<std::int32_t>(k)).first->second;
    }
    return representative;
}

// For each vertex the first within the tolerance, itself if none.
std::vector<std::int32_t> find_near(const std::vector<Vec3>& vertices) {
    Eigen::AlignedBox3d box;
    for (const Vec3& v : vertices) box.extend(v);
    const double tolerance = std::max(kTolerance * box.diagonal().norm(), 1e-300);
    // cells of twice the tolerance: near vertices lie in the same or a neighbouring cell
    const auto cell_of = [&](const Vec3& v) -> Key {
        Key cell;
        for (int d = 0; d < 3; ++d)
            cell[static_cast<std::size_t>(d)] = static_cast<std::uint64_t>(
                std::floor((v[d] - box.min()[d]) / (2.0 * tolerance)) + 1.0);
        return cell;
    };
    std::unordered_map<Key, std::vector<std::int32_t>, HashKey> cells;
    std::vector<std::int32_t> representative(vertices.size());
    for (std::size_t k = 0; k < vertices.size(); ++k) {
        const Key at = cell_of(vertices[k]);
        auto found = static_cast<std::int32_t>(k);
        for (std::uint64_t n = 0; n < 27; ++n) {
            const auto near =
                cells.find({at[0] + n % 3 - 1, at[1] + n / 3 % 3 - 1, at[2] + n / 9 - 1});
            if (near == cells.end()) continue;
            for (const std::int32_t other : near->second)
                if ((vertices[static_cast<std::size_t>(other)] - vertices[k]).norm() <= tolerance)
                    found = std::min(found, other);
        }
        representative[k] = found;
        if (found == static_cast<std::int32_t>(k)) cells[at].push_back(found);
    }
    return representative;
}

// Gives corners their representatives, drops what collapses or repeats. Returns the vertices
// merged.
std::int64_t merge(TriangleMesh& mesh, const std::vector<std::int32_t>& representative,
                   WeldCounts& counts) {
    std::vector<std::uint8_t> keep(mesh.triangles.size(), 1);
    std::unordered_set<Key, HashKey> seen;
    seen.reserve(mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        auto& corner = mesh.triangles[t];
        for (std::int32_t& v : corner) v = representative[static_cast<std::size_t>(v)];
        if (corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0]) {
            ++counts.degenerate_triangles;
            keep[t] = 0;
            continue;
        }
        // the same triangle whichever corner comes first; its other side is another triangle
        std::array<std::int32_t, 3> turned = corner;
        std::rotate(turned.begin(), std::min_element(turned.begin(), turned.end()), turned.end());
        Key key;
        std::transform(turned.begin(), turned.end(), key.begin(),
                       [](std::int32_t v) { return static_cast<std::uint64_t>(v); });
        if (seen.insert(key).second) continue;
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

WeldCounts weld(TriangleMesh& mesh) {
    WeldCounts counts;
    counts.equal_vertices = merge(mesh, find_equal(mesh.vertices), counts);
    const auto edges = edge_table(mesh);
    const bool open = std::any_of(edges.begin(), edges.end(),
                                  [](const MeshEdge& edge) { return edge.count == 1; });
    if (open) counts.near_vertices = merge(mesh, find_near(mesh.vertices), counts);
    return counts;
}

}  // namespace ice
