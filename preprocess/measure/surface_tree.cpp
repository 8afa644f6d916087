// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/measure/surface_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "preprocess/clean/edge_table.hpp"
#include "preprocess/measure/closest_on_triangle.hpp"

namespace ice {

namespace {

constexpr std::int32_t kLeafSize = 4;

// Squared distance of a point from a box, 0 inside; plain arithmetic, the hottest line of all.
double box_distance_sq(const Vec3& low, const Vec3& high, const Vec3& p) {
    double sum = 0.0;
    for (int d = 0; d < 3; ++d) {
        const double gap = std::max(std::max(low[d] - p[d], p[d] - high[d]), 0.0);
        sum += gap * gap;
    }
    return sum;
}

double corner_angle(const Vec3& at, const Vec3& b, const Vec3& c) {
    const Vec3 u = (b - at).normalized(), v = (c - at).normalized();
    return std::acos(std::clamp(u.dot(v), -1.0, 1.0));
}

}  // namespace

SurfaceTree::SurfaceTree(const TriangleMesh& mesh) : mesh_(mesh) {
    const auto count = static_cast<std::int32_t>(mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        centers_.push_back((mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0);
    order_.resize(static_cast<std::size_t>(count));
    std::iota(order_.begin(), order_.end(), 0);
    nodes_.reserve(mesh.triangles.size());
    build(0, count);
    corners_.reserve(order_.size());
    for (const std::int32_t t : order_) {
        const auto tt = static_cast<std::size_t>(t);
        corners_.push_back({mesh.corner(tt, 0), mesh.corner(tt, 1), mesh.corner(tt, 2)});
    }
    centers_ = {};
    build_normals();
}

std::int32_t SurfaceTree::build(std::int32_t first, std::int32_t count) {
    const auto index = static_cast<std::int32_t>(nodes_.size());
    nodes_.emplace_back();
    Eigen::AlignedBox3d box, centers;
    for (std::int32_t k = first; k < first + count; ++k) {
        const auto t = static_cast<std::size_t>(order_[static_cast<std::size_t>(k)]);
        for (int c = 0; c < 3; ++c) box.extend(mesh_.corner(t, c));
        centers.extend(centers_[t]);
    }
    nodes_[static_cast<std::size_t>(index)].low = box.min();
    nodes_[static_cast<std::size_t>(index)].high = box.max();
    if (count <= kLeafSize) {
        nodes_[static_cast<std::size_t>(index)].first = first;
        nodes_[static_cast<std::size_t>(index)].count = count;
        return index;
    }
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
    build(first, half);
    const std::int32_t right = build(first + half, count - half);
    nodes_[static_cast<std::size_t>(index)].right = right;
    return index;
}

void SurfaceTree::build_normals() {
    normals_.resize(mesh_.triangles.size());
    corner_normals_.assign(mesh_.vertices.size(), Vec3::Zero());
    edge_normals_.resize(mesh_.triangles.size());
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
        normals_[t] = mesh_.area_vector(t).normalized();
        for (int k = 0; k < 3; ++k) {
            const double angle = corner_angle(mesh_.corner(t, k), mesh_.corner(t, (k + 1) % 3),
                                              mesh_.corner(t, (k + 2) % 3));
            const auto v = mesh_.triangles[t][static_cast<std::size_t>(k)];
            corner_normals_[static_cast<std::size_t>(v)] += angle * normals_[t];
        }
    }
    for (const MeshEdge& edge : edge_table(mesh_)) {
        Vec3 sum = Vec3::Zero();
        for (const std::int32_t t : edge.triangles)
            if (t >= 0) sum += normals_[static_cast<std::size_t>(t)];
        for (const std::int32_t t : edge.triangles) {
            if (t < 0) continue;
            const auto& corner = mesh_.triangles[static_cast<std::size_t>(t)];
            for (std::size_t k = 0; k < 3; ++k) {
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
    return (p - foot.point).dot(normal) < 0.0;
}

// Visits the leaves whose boxes are not ruled out by skip(distance squared), the nearer child of a
// node first: in a closest-point search it usually rules out the other.
template <class Skip, class Visit>
void SurfaceTree::visit_leaves(const Vec3& p, const Skip& skip, const Visit& visit) const {
    std::int32_t stack[64];
    int depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
        const std::int32_t at = stack[--depth];
        const Node& node = nodes_[static_cast<std::size_t>(at)];
        if (skip(box_distance_sq(node.low, node.high, p))) continue;
        if (node.count == 0) {
            const std::int32_t left = at + 1, right = node.right;
            const auto distance = [&](std::int32_t child) {
                const Node& box = nodes_[static_cast<std::size_t>(child)];
                return box_distance_sq(box.low, box.high, p);
            };
            const bool left_first = distance(left) <= distance(right);
            stack[depth++] = left_first ? right : left;
            stack[depth++] = left_first ? left : right;
            continue;
        }
        for (std::int32_t k = node.first; k < node.first + node.count; ++k)
            visit(order_[static_cast<std::size_t>(k)], corners_[static_cast<std::size_t>(k)]);
    }
}

Foot SurfaceTree::closest(const Vec3& p) const {
    Foot best;
    double best_sq = std::numeric_limits<double>::infinity();
    int feature = 6;
    visit_leaves(
        p, [&](double sq) { return sq >= best_sq; },
        [&](std::int32_t t, const Corners& corner) {
            const TrianglePoint q = closest_on_triangle(p, corner[0], corner[1], corner[2]);
            const double sq = (p - q.point).squaredNorm();
            if (sq > best_sq || (sq == best_sq && t > best.triangle)) return;
            best_sq = sq;
            best.point = q.point;
            best.triangle = t;
            feature = q.feature;
        });
    best.distance = std::sqrt(best_sq);
    best.inside = is_inside(p, best, feature);
    return best;
}

void SurfaceTree::within(const Vec3& p, double range, std::vector<Foot>& out) const {
    out.clear();
    visit_leaves(
        p, [&](double sq) { return sq > range * range; },
        [&](std::int32_t t, const Corners& corner) {
            const TrianglePoint q = closest_on_triangle(p, corner[0], corner[1], corner[2]);
            const double distance = (p - q.point).norm();
            if (distance <= range) out.push_back({q.point, distance, false, t});
        });
    std::sort(out.begin(), out.end(),
              [](const Foot& l, const Foot& r) { return l.triangle < r.triangle; });
}

bool SurfaceTree::is_clear(const Vec3& p, double range) const {
    bool clear = true;
    visit_leaves(
        p, [&](double sq) { return !clear || sq >= range * range; },
        [&](std::int32_t, const Corners& corner) {
            const TrianglePoint q = closest_on_triangle(p, corner[0], corner[1], corner[2]);
            if ((p - q.point).squaredNorm() < range * range) clear = false;
        });
    return clear;
}

}  // namespace ice
