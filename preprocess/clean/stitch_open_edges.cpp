// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/clean/stitch_open_edges.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <map>

#include "common/geometry/edge_table.hpp"
#include "preprocess/clean/near_edges.hpp"
#include "preprocess/clean/weld.hpp"

namespace ice {

namespace {

// Widths of cracks that are stitched, over the diagonal [-]: 3 cm and 10 cm on a ship of 100 m, as
// coarse tessellations of curved patches leave them. Larger values would close real gaps, smaller
// ones leave such cracks open.
constexpr double kStitchTolerances[] = {3e-4, 1e-3};
// Width of a crack over the length of an open edge beside it [-], at most. Of more an edge could
// collapse when its ends move.
constexpr double kOfEdge = 1.0 / 3.0;
// Distance over an open edge's length [-] within which another open edge runs beside it: around an
// opening the next edge that is not a vertex's own begins a whole length away.
constexpr double kBeside = 0.9;
// Rounds of splitting and merging at most [-]: each stitch makes room for the next one, and a round
// without a split ends them. Fewer leave cracks open, more take longer.
constexpr int kRounds = 4;

using Triple = std::array<std::int32_t, 3>;

const Vec3& at(const TriangleMesh& mesh, std::int32_t v) {
    return mesh.vertices[static_cast<std::size_t>(v)];
}

struct OpenEdges {
    std::vector<MeshEdge> edges;
    std::vector<std::int32_t> vertices;
    std::vector<double> reach;  // per vertex of the mesh: how wide a crack may be there; 0: none
};

OpenEdges find_open_edges(const TriangleMesh& mesh, double tolerance, double of_edge = kOfEdge) {
    OpenEdges out;
    out.reach.assign(mesh.vertices.size(), 0.0);
    for (const MeshEdge& edge : edge_table(mesh)) {
        // A vertex may close a crack up to a share of its shorter open edge: beyond, edges of the
        // surface itself would be drawn together.
        if (edge.count != 1) continue;
        out.edges.push_back(edge);
        const double most =
            std::min(tolerance, of_edge * (at(mesh, edge.b) - at(mesh, edge.a)).norm());
        for (const std::int32_t v : {edge.a, edge.b}) {
            double& reach = out.reach[static_cast<std::size_t>(v)];
            if (reach == 0.0) out.vertices.push_back(v);
            reach = reach == 0.0 ? most : std::min(reach, most);
        }
    }
    std::sort(out.vertices.begin(), out.vertices.end());
    return out;
}

// For each open edge the vertices that go into it: their place along it and their number.
using Inserted =
    std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::pair<double, std::int32_t>>>;

// The triangles that fill a -> ... -> b -> ... -> c -> ..., with vertices on those of its three
// sides that are sides of the mesh.
void fill(const Triple& t, std::array<bool, 3> of_mesh, const Inserted& inserted,
          std::vector<Triple>& out) {
    // The side is replaced by a walk over its vertices, and the triangle by a fan from the far
    // corner; the fan's outer sides may have vertices of their own.
    for (std::size_t k = 0; k < 3; ++k) {
        const std::int32_t a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
        const auto found = of_mesh[k] ? inserted.find(std::minmax(a, b)) : inserted.end();
        if (found == inserted.end()) continue;
        std::vector<std::int32_t> walk;
        for (const auto& [along, v] : found->second)
            if (v != c) walk.push_back(v);
        if (a > b) std::reverse(walk.begin(), walk.end());
        walk.insert(walk.begin(), a);
        walk.push_back(b);
        for (std::size_t n = 0; n + 1 < walk.size(); ++n)
            fill({walk[n], walk[n + 1], c},
                 {false, n + 2 == walk.size() && of_mesh[(k + 1) % 3],
                  n == 0 && of_mesh[(k + 2) % 3]},
                 inserted, out);
        return;
    }
    out.push_back(t);
}

bool split_edges(TriangleMesh& mesh, double tolerance, StitchCounts& counts) {
    // open edges, and how far from each a vertex of another one may be
    const OpenEdges open = find_open_edges(mesh, tolerance);
    std::vector<Vec3> points;
    std::vector<std::pair<Vec3, Vec3>> segments;
    for (const std::int32_t v : open.vertices) points.push_back(at(mesh, v));
    std::vector<double> reach;
    for (const MeshEdge& edge : open.edges) {
        segments.emplace_back(at(mesh, edge.a), at(mesh, edge.b));
        reach.push_back(
            std::min(tolerance, kOfEdge * (segments.back().second - segments.back().first).norm()));
    }
    Inserted inserted;
    std::size_t last = points.size();  // a vertex is inserted into the nearest edge only
    for (const NearEdge& near : find_near_edges(points, segments, reach)) {
        const MeshEdge& edge = open.edges[near.edge];
        const std::int32_t v = open.vertices[near.point];
        if (near.point == last || v == edge.a || v == edge.b) continue;
        last = near.point;
        inserted[{edge.a, edge.b}].emplace_back(near.along, v);
        counts.widest = std::max(counts.widest, near.distance);
    }
    if (inserted.empty()) return false;
    counts.split += static_cast<std::int64_t>(inserted.size());
    // along each edge from its begin to its end
    for (auto& [edge, walk] : inserted) std::sort(walk.begin(), walk.end());
    TriangleMesh out;
    out.vertices = mesh.vertices;
    out.region_names = mesh.region_names;
    std::vector<Triple> pieces;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        pieces.clear();
        fill(mesh.triangles[t], {true, true, true}, inserted, pieces);
        for (const Triple& piece : pieces) {
            out.triangles.push_back(piece);
            out.region.push_back(mesh.region[t]);
        }
    }
    mesh = std::move(out);
    return true;
}

}  // namespace

StitchCounts stitch_open_edges(TriangleMesh& mesh) {
    StitchCounts counts;
    Eigen::AlignedBox3d box;
    for (const Vec3& v : mesh.vertices) box.extend(v);
    // narrow cracks first: once closed they have no open edges for the wide tolerance
    for (const double of_diagonal : kStitchTolerances) {
        const double tolerance = of_diagonal * box.diagonal().norm();
        const auto merge_ends = [&] {
            WeldCounts dropped;
            counts.merged += merge_near(mesh, find_open_edges(mesh, tolerance).reach, dropped);
        };
        merge_ends();
        // a crack of short steps closes from its ends
        for (int round = 0; round < kRounds && split_edges(mesh, tolerance, counts); ++round)
            merge_ends();  // drops pieces that repeat or collapse
    }
    return counts;
}

WideCracks find_wide_cracks(const TriangleMesh& mesh) {
    // No tolerance bounds the search here: the cracks are not closed but named, with their width,
    // so that the user can choose one.
    const double longest = std::numeric_limits<double>::infinity();
    const OpenEdges open = find_open_edges(mesh, longest, kBeside);
    std::vector<Vec3> points;
    for (const std::int32_t v : open.vertices) points.push_back(at(mesh, v));
    std::vector<std::pair<Vec3, Vec3>> segments;
    std::vector<double> reach;
    for (const MeshEdge& edge : open.edges) {
        segments.emplace_back(at(mesh, edge.a), at(mesh, edge.b));
        reach.push_back(kBeside * (segments.back().second - segments.back().first).norm());
    }
    WideCracks out;
    out.vertices = static_cast<std::int64_t>(points.size());
    std::size_t last = points.size();
    for (const NearEdge& near : find_near_edges(points, segments, reach)) {
        const MeshEdge& edge = open.edges[near.edge];
        const std::int32_t v = open.vertices[near.point];
        if (near.point == last || v == edge.a || v == edge.b) continue;
        if (near.distance > open.reach[static_cast<std::size_t>(v)]) continue;
        last = near.point;
        ++out.beside_another;
        out.widest = std::max(out.widest, near.distance);
    }
    return out;
}

}  // namespace ice
