// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/shape/solid.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "common/math/ordered_products.hpp"

namespace ice {

namespace {

// Facets whose normals are this near (cosine [-]; 1e-5 rad) lie in one plane: vertices of a file
// are often floats. A larger angle joins facets of gently curved faces, a smaller one makes two
// planes of one.
constexpr double kSameNormal = 1.0 - 5e-11;

// Lengths below this share of the mesh's size [-] are rounding of its vertices. Larger takes hulls
// that are a little hollow for convex; smaller finds no float mesh convex.
constexpr double kVertexRounding = 1e-6;

// A sort key: first the coordinates that mirror images about y = 0 have in common, then y.
std::tuple<double, double, double, double> mirror_key(const Vec3& v) {
    return {v.x(), std::abs(v.y()), v.z(), v.y()};
}

double foremost(const std::vector<Vec3>& points, const Vec3& n) {
    double most = n.dot(points.front());
    for (const Vec3& p : points) most = std::max(most, n.dot(p));
    return most;
}

double size_of(const std::vector<Vec3>& points) {
    Eigen::AlignedBox3d box;
    for (const Vec3& p : points) box.extend(p);
    return points.empty() ? 0.0 : box.sizes().maxCoeff();
}

// The mesh's vertices without repeats.
bool list_points(const TriangleMesh& mesh, double same, std::vector<Vec3>& out) {
    for (const Vec3& v : mesh.vertices) {
        if (std::any_of(out.begin(), out.end(),
                        [&](const Vec3& u) { return (u - v).cwiseAbs().maxCoeff() <= same; }))
            continue;
        // those within a plane or an edge are no corners: room for some
        if (out.size() == 4 * ConvexPiece::kMost) return false;
        out.push_back(v);
    }
    return out.size() > 3;
}

// The planes of a convex mesh; false where it is none, or has too many.
bool list_planes(const TriangleMesh& mesh, const std::vector<Vec3>& points, double flat,
                 std::vector<HalfSpace>& out) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Vec3 a = mesh.corner(t, 0), b = mesh.corner(t, 1), c = mesh.corner(t, 2);
        const Vec3 across = (b - a).cross(c - a);
        const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
        if (across.norm() <= flat * longest) continue;
        const Vec3 n = across / across.norm();
        if (std::any_of(out.begin(), out.end(),
                        [&](const HalfSpace& p) { return p.normal.dot(n) > kSameNormal; }))
            continue;
        // Where another vertex lies before the facet's plane the mesh is not convex.
        const double offset = foremost(points, n);
        if (std::min({n.dot(a), n.dot(b), n.dot(c)}) < offset - flat) return false;
        if (out.size() == ConvexPiece::kMost) return false;
        out.push_back({n, offset});
    }
    std::sort(out.begin(), out.end(), [](const HalfSpace& l, const HalfSpace& r) {
        return mirror_key(l.normal) < mirror_key(r.normal);
    });
    return out.size() > 3;
}

// Keeps the points in which three planes or more meet.
void keep_corners(const std::vector<HalfSpace>& planes, double flat, std::vector<Vec3>& points) {
    std::erase_if(points, [&](const Vec3& p) {
        return std::count_if(planes.begin(), planes.end(), [&](const HalfSpace& plane) {
                   return plane.normal.dot(p) >= plane.offset - flat;
               }) < 3;
    });
    std::sort(points.begin(), points.end(),
              [](const Vec3& l, const Vec3& r) { return mirror_key(l) < mirror_key(r); });
}

// The corners that lie in both planes and are farthest apart: their edge, if they have one.
void add_edge(const std::vector<HalfSpace>& planes, const std::vector<Vec3>& corners,
              std::int32_t left, std::int32_t right, double flat, std::vector<SolidEdge>& out) {
    const HalfSpace &l = planes[static_cast<std::size_t>(left)],
                    &r = planes[static_cast<std::size_t>(right)];
    // of all corners in both planes the first and the last along their line
    const Vec3 along = l.normal.cross(r.normal);
    SolidEdge edge{-1, -1, left, right};
    double first = 0.0, last = 0.0;
    for (std::int32_t k = 0; k < std::ssize(corners); ++k) {
        const Vec3& p = corners[static_cast<std::size_t>(k)];
        if (l.normal.dot(p) < l.offset - flat || r.normal.dot(p) < r.offset - flat) continue;
        const double at = along.dot(p);
        if (edge.begin < 0 || at < first) {
            first = at;
            edge.begin = k;
        }
        if (edge.end < 0 || at > last) {
            last = at;
            edge.end = k;
        }
    }
    if (edge.begin >= 0 && edge.begin != edge.end) out.push_back(edge);
}

// The corners round plane k; empty where its edges are no ring.
std::vector<std::int32_t> loop_round(const std::vector<SolidEdge>& edges, std::int32_t k) {
    std::vector<std::pair<std::int32_t, std::int32_t>> steps;
    for (const SolidEdge& e : edges) {
        if (e.left == k) steps.emplace_back(e.begin, e.end);
        if (e.right == k) steps.emplace_back(e.end, e.begin);
    }
    std::vector<std::int32_t> loop;
    if (steps.empty()) return loop;
    // The edges are oriented round the plane: each one begins where the one before it ends.
    std::int32_t at = steps.front().first;
    for (std::size_t n = 0; n < steps.size(); ++n) {
        loop.push_back(at);
        const auto next = std::find_if(steps.begin(), steps.end(),
                                       [&](const auto& step) { return step.first == at; });
        if (next == steps.end()) return {};
        at = next->second;
    }
    if (at != loop.front() || loop.size() < 3) return {};
    return loop;
}

std::vector<SidePlane> side_planes_of(const std::vector<std::int32_t>& loop, const Vec3& normal,
                                      const std::vector<Vec3>& corners) {
    std::vector<SidePlane> out;
    for (std::size_t k = 0; k < loop.size(); ++k) {
        const Vec3 &from = corners[static_cast<std::size_t>(loop[k])],
                   &to = corners[static_cast<std::size_t>(loop[(k + 1) % loop.size()])];
        const Vec3 outward = (to - from).normalized().cross(normal);
        // the farther end, so that no corner of the face is beyond its side plane by rounding
        out.push_back({outward, std::max(ordered_dot(outward, from), ordered_dot(outward, to))});
    }
    return out;
}

}  // namespace

VectorBlocks::VectorBlocks(const std::vector<Vec3>& list) : count_(list.size()) {
    constexpr std::size_t kLanes = VectorBlock::kLanes;
    blocks_.resize((count_ + kLanes - 1) / kLanes);
    for (std::size_t k = 0; k < kLanes * blocks_.size(); ++k) {
        // Copies of the last vector fill up the last block. They change no minimum and no maximum,
        // so the kernels need no mask.
        const Vec3& v = list[std::min(k, count_ - 1)];
        VectorBlock& block = blocks_[k / kLanes];
        block.x[k % kLanes] = v.x();
        block.y[k % kLanes] = v.y();
        block.z[k % kLanes] = v.z();
    }
}

namespace {

// Fills the blocks of edges from their ends and planes.
void fill_edge_blocks(ConvexPiece& piece) {
    std::vector<Vec3> middle, along, left, right;
    for (const SolidEdge& e : piece.edges) {
        const Vec3 from = piece.corners[static_cast<std::size_t>(e.begin)],
                   to = piece.corners[static_cast<std::size_t>(e.end)];
        middle.push_back(0.5 * (from + to));
        along.push_back((to - from).normalized());
        left.push_back(piece.normals[static_cast<std::size_t>(e.left)]);
        right.push_back(piece.normals[static_cast<std::size_t>(e.right)]);
    }
    piece.edge_middle = VectorBlocks(middle);
    piece.edge_along = VectorBlocks(along);
    piece.edge_left = VectorBlocks(left);
    piece.edge_right = VectorBlocks(right);
}

}  // namespace

ConvexPiece make_convex_piece(const TriangleMesh& mesh) {
    const double flat = kVertexRounding * size_of(mesh.vertices);
    std::vector<Vec3> points;
    std::vector<HalfSpace> planes;
    if (!list_points(mesh, flat, points) || !list_planes(mesh, points, flat, planes)) return {};
    keep_corners(planes, flat, points);
    if (points.size() > ConvexPiece::kMost) return {};
    std::vector<SolidEdge> edges;
    for (std::int32_t l = 0; l < std::ssize(planes); ++l)
        for (std::int32_t r = l + 1; r < std::ssize(planes); ++r)
            add_edge(planes, points, l, r, flat, edges);
    return piece_of(planes, points, std::move(edges));
}

ConvexPiece piece_of(const std::vector<HalfSpace>& planes, const std::vector<Vec3>& corners,
                     std::vector<SolidEdge> edges) {
    ConvexPiece out;
    std::vector<Vec3> normals;
    for (const HalfSpace& p : planes) {
        // a face without a closed loop of edges: the planes bound no convex solid
        out.loops.push_back(loop_round(edges, static_cast<std::int32_t>(normals.size())));
        if (out.loops.back().empty()) return {};
        out.side_planes.push_back(side_planes_of(out.loops.back(), p.normal, corners));
        normals.push_back(p.normal);
        out.offsets.push_back(p.offset);
    }
    // Euler's formula: with other numbers the faces do not close round a solid
    if (corners.size() + planes.size() != edges.size() + 2) return {};
    out.normals = VectorBlocks(normals);
    // kernels read offsets in whole blocks, too
    while (out.offsets.size() % VectorBlock::kLanes != 0) out.offsets.push_back(out.offsets.back());
    out.corners = VectorBlocks(corners);
    out.edges = std::move(edges);
    fill_edge_blocks(out);
    return out;
}

}  // namespace ice
