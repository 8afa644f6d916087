// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/geometry/surface_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/base/assert.hpp"
#include "common/geometry/closest_on_triangle.hpp"
#include "common/geometry/edge_table.hpp"

namespace ice {

namespace {

// Triangles of a leaf [-]. A node has four lanes for boxes, and a box around one triangle costs as
// much as the plane test of that triangle. The results do not depend on it, only the time.
constexpr std::int32_t kLeafTriangles = 4;

double corner_angle(const Vec3& at, const Vec3& b, const Vec3& c) {
    const Vec3 u = (b - at).normalized(), v = (c - at).normalized();
    return std::acos(std::clamp(u.dot(v), -1.0, 1.0));
}

}  // namespace

SurfaceTree::SurfaceTree(const TriangleMesh& mesh) : mesh_(mesh) {
    ICE_ASSERT(!mesh.triangles.empty());
    const auto count = static_cast<std::int32_t>(mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        centers_.push_back((mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0);
    order_.resize(static_cast<std::size_t>(count));
    std::iota(order_.begin(), order_.end(), 0);
    Eigen::AlignedBox3d box;
    for (const Vec3& v : mesh.vertices) box.extend(v);
    middle_ = box.center();
    // a float keeps 24 bits; asking points at most a box's size away may add as much again
    grain_ = std::ldexp(box.sizes().maxCoeff(), -21);
    nodes_.reserve(mesh.triangles.size() / 4 + 2);
    build(0, count);
    // corners in the order of the leaves: those of one leaf lie side by side in memory
    corners_.reserve(order_.size());
    rank_.resize(order_.size());
    for (const std::int32_t t : order_) {
        const auto tt = static_cast<std::size_t>(t);
        rank_[tt] = static_cast<std::int32_t>(corners_.size());
        corners_.push_back({mesh.corner(tt, 0), mesh.corner(tt, 1), mesh.corner(tt, 2)});
    }
    centers_ = {};
    build_normals();
}

// Halves a range by the triangles' centres along the longest extent; returns the first half's size.
std::int32_t SurfaceTree::split(std::int32_t first, std::int32_t count) {
    Eigen::AlignedBox3d centers;
    for (std::int32_t k = first; k < first + count; ++k)
        centers.extend(centers_[static_cast<std::size_t>(order_[static_cast<std::size_t>(k)])]);
    int axis = 0;
    centers.sizes().maxCoeff(&axis);
    const std::int32_t half = count / 2;
    // ties by triangle number, so that equal meshes give equal trees
    std::nth_element(order_.begin() + first, order_.begin() + first + half,
                     order_.begin() + first + count, [&](std::int32_t l, std::int32_t r) {
                         const double cl = centers_[static_cast<std::size_t>(l)][axis];
                         const double cr = centers_[static_cast<std::size_t>(r)][axis];
                         return cl < cr || (cl == cr && l < r);
                     });
    return half;
}

void SurfaceTree::set_box(Node& node, int k, std::int32_t first, std::int32_t count) const {
    Eigen::AlignedBox3d box;
    for (std::int32_t t = first; t < first + count; ++t)
        for (int c = 0; c < 3; ++c)
            box.extend(
                mesh_.corner(static_cast<std::size_t>(order_[static_cast<std::size_t>(t)]), c));
    for (int d = 0; d < 3; ++d) {
        // outwards by the grain: the cast to float may round either way
        node.low[d][k] = static_cast<float>(box.min()[d] - middle_[d] - grain_);
        node.high[d][k] = static_cast<float>(box.max()[d] - middle_[d] + grain_);
    }
}

std::int32_t SurfaceTree::build(std::int32_t first, std::int32_t count) {
    const auto index = static_cast<std::int32_t>(nodes_.size());
    // its place first, its content last: the children follow it in nodes_, and the vector may move
    nodes_.emplace_back();
    std::array<std::pair<std::int32_t, std::int32_t>, 4> part{};
    int parts = 0;
    const auto divide = [&](std::int32_t from, std::int32_t size, int more, auto&& self) -> void {
        if (more == 0 || size <= kLeafTriangles) {
            if (size > 0) part[static_cast<std::size_t>(parts++)] = {from, size};
            return;
        }
        // two halvings make four parts, one per lane of a node
        const std::int32_t half = split(from, size);
        self(from, half, more - 1, self);
        self(from + half, size - half, more - 1, self);
    };
    divide(first, count, 2, divide);
    Node node;
    for (int k = 0; k < 4; ++k) {
        const auto [from, size] = part[static_cast<std::size_t>(k)];
        if (k < parts) set_box(node, k, from, size);
        node.child[k] = from;
        node.count[k] = k < parts ? size : -1;
        if (k < parts) continue;
        // an empty place is infinitely far
        for (int d = 0; d < 3; ++d)
            node.low[d][k] = node.high[d][k] = std::numeric_limits<float>::infinity();
    }
    for (int k = 0; k < parts; ++k)
        // a part that is still too large becomes a node of its own: count 0, child its index
        if (node.count[k] > kLeafTriangles) {
            node.child[k] = build(node.child[k], node.count[k]);
            node.count[k] = 0;
        }
    nodes_[static_cast<std::size_t>(index)] = node;
    return index;
}

void SurfaceTree::build_normals() {
    normals_.resize(mesh_.triangles.size());
    corner_normals_.assign(mesh_.vertices.size(), Vec3::Zero());
    edge_normals_.resize(mesh_.triangles.size());
    // Angle-weighted normals at vertices, sums of both faces' normals at edges: with these the sign
    // of the distance is right wherever the nearest point lies (Baerentzen and Aanaes 2005).
    double area = 0.0;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
        const Vec3 vector = mesh_.area_vector(t);
        area += vector.norm();
        normals_[t] = vector.normalized();
        for (int k = 0; k < 3; ++k) {
            const double angle = corner_angle(mesh_.corner(t, k), mesh_.corner(t, (k + 1) % 3),
                                              mesh_.corner(t, (k + 2) % 3));
            const auto v = mesh_.triangles[t][static_cast<std::size_t>(k)];
            corner_normals_[static_cast<std::size_t>(v)] += angle * normals_[t];
        }
    }
    // A length of the order of a triangle's edge: the root of the mean area.
    mean_edge_ = std::sqrt(area / static_cast<double>(std::max<std::size_t>(normals_.size(), 1)));
    for (const MeshEdge& edge : edge_table(mesh_)) {
        Vec3 sum = Vec3::Zero();
        for (const std::int32_t t : edge.triangles)
            if (t >= 0) sum += normals_[static_cast<std::size_t>(t)];
        for (const std::int32_t t : edge.triangles) {
            if (t < 0) continue;
            const auto& corner = mesh_.triangles[static_cast<std::size_t>(t)];
            for (std::size_t k = 0; k < 3; ++k) {
                // found by its two vertices: the triangle may run along the edge either way
                const auto [a, b] = std::minmax({corner[k], corner[(k + 1) % 3]});
                if (a == edge.a && b == edge.b) edge_normals_[static_cast<std::size_t>(t)][k] = sum;
            }
        }
    }
}

bool SurfaceTree::is_inside(const Vec3& p, const Foot& foot, int feature) const {
    const auto t = static_cast<std::size_t>(foot.triangle);
    const auto k = static_cast<std::size_t>(feature);
    const Vec3& normal = feature < 3
                             ? corner_normals_[static_cast<std::size_t>(mesh_.triangles[t][k])]
                         : feature < 6 ? edge_normals_[t][k - 3]
                                       : normals_[t];
    // On the surface the product is 0: outside. The normal of one face alone would give a wrong
    // sign near an edge, whose points both faces share.
    return (p - foot.point).dot(normal) < 0.0;
}

// Visits the leaves whose boxes are not ruled out by skip(distance squared), the nearest of a
// node's children first: in a closest-point search it usually rules out the others.
template <class Skip, class Visit>
void SurfaceTree::visit_leaves(const Vec3& p, const Skip& skip, const Visit& visit) const {
    struct Entry {
        double distance_sq;
        std::int32_t child, count;
    };
    const Vec3 from = p - middle_;
    const float x = static_cast<float>(from.x()), y = static_cast<float>(from.y()),
                z = static_cast<float>(from.z());
    // A tree of T triangles is log4(T) deep and leaves at most three entries per level: 96 are
    // enough for 4^32 triangles.
    Entry stack[96];
    int depth = 0;
    stack[depth++] = {0.0, 0, 0};
    while (depth > 0) {
        const Entry entry = stack[--depth];
        if (skip(entry.distance_sq)) continue;
        for (std::int32_t k = entry.child; k < entry.child + entry.count; ++k)
            visit(order_[static_cast<std::size_t>(k)], corners_[static_cast<std::size_t>(k)]);
        if (entry.count > 0) continue;
        const Node& node = nodes_[static_cast<std::size_t>(entry.child)];
        const Eigen::Array4f dx = (node.low[0] - x).max(x - node.high[0]).max(0.0f);
        const Eigen::Array4f dy = (node.low[1] - y).max(y - node.high[1]).max(0.0f);
        const Eigen::Array4f dz = (node.low[2] - z).max(z - node.high[2]).max(0.0f);
        const Eigen::Array4f sq = dx * dx + dy * dy + dz * dz;
        const int bottom = depth;
        for (int k = 0; k < 4; ++k) {
            // less by the most that the sum of squares may have been rounded up
            const double distance_sq = static_cast<double>(sq[k]) * (1.0 - 1e-6);
            if (node.count[k] < 0 || skip(distance_sq)) continue;
            // insertion by distance: the nearest child ends on top of the stack
            int at = depth++;
            for (; at > bottom && stack[at - 1].distance_sq < distance_sq; --at)
                stack[at] = stack[at - 1];
            stack[at] = {distance_sq, node.child[k], node.count[k]};
        }
    }
}

// No point of the triangle is within the range, because its plane is not: a few multiplications
// instead of the foot. The grain covers rounding.
bool SurfaceTree::beyond_plane(const Vec3& p, std::int32_t t, const Corners& corner,
                               double range_sq) const {
    const double height = std::abs((p - corner[0]).dot(normal(t))) - grain_;
    return height > 0.0 && height * height > range_sq;
}

Foot SurfaceTree::closest(const Vec3& p, std::int32_t hint) const {
    Foot best;
    double best_sq = std::numeric_limits<double>::infinity();
    int feature = 6;
    const auto look = [&](std::int32_t t, const Corners& corner) {
        // the plane's distance is a lower bound of the triangle's
        if (beyond_plane(p, t, corner, best_sq)) return;
        const TrianglePoint q = closest_on_triangle(p, corner[0], corner[1], corner[2]);
        const double sq = (p - q.point).squaredNorm();
        if (sq > best_sq || (sq == best_sq && t > best.triangle)) return;
        best_sq = sq;
        best.point = q.point;
        best.triangle = t;
        feature = q.feature;
    };
    // a near triangle first rules out most of the boxes
    if (hint >= 0)
        look(hint, corners_[static_cast<std::size_t>(rank_[static_cast<std::size_t>(hint)])]);
    // boxes as near as the best are searched, too: of equal feet the first triangle's counts
    visit_leaves(
        p, [&](double sq) { return sq > best_sq; }, look);
    best.distance = std::sqrt(best_sq);
    best.inside = is_inside(p, best, feature);
    return best;
}

void SurfaceTree::within(const Vec3& p, double range, std::vector<Foot>& out) const {
    out.clear();
    visit_leaves(
        p, [&](double sq) { return sq > range * range; },
        [&](std::int32_t t, const Corners& corner) {
            if (beyond_plane(p, t, corner, range * range)) return;
            const TrianglePoint q = closest_on_triangle(p, corner[0], corner[1], corner[2]);
            const double distance = (p - q.point).norm();
            if (distance <= range) out.push_back({q.point, distance, false, t});
        });
}

bool SurfaceTree::is_clear(const Vec3& p, double range) const {
    bool clear = true;
    visit_leaves(
        // one near triangle decides: nothing more is visited
        p, [&](double sq) { return !clear || sq >= range * range; },
        [&](std::int32_t t, const Corners& corner) {
            if (beyond_plane(p, t, corner, range * range)) return;
            const TrianglePoint q = closest_on_triangle(p, corner[0], corner[1], corner[2]);
            if ((p - q.point).squaredNorm() < range * range) clear = false;
        });
    return clear;
}

}  // namespace ice
