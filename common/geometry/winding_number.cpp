// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/geometry/winding_number.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace ice {

namespace {

// Triangles of a leaf [-], whose solid angles are added up. It moves the time only.
constexpr std::int32_t kLeafSize = 6;
// Bound of the error of at(), times beta squared [-]: 0.16 was measured, and a quarter is added. A
// smaller bound saves time and risks a wrong side near openings.
constexpr double kError = 0.2;
// Accuracies that contains() tries in turn: errors of 0.05, 0.003 and 0.0002. Points away from
// openings are decided by the first; beyond the last all solid angles are added up.
constexpr double kBetas[] = {WindingNumber::kBeta, 8.0, 32.0};

}  // namespace

double solid_angle(const Vec3& p, const Vec3& corner_a, const Vec3& corner_b,
                   const Vec3& corner_c) {
    const Vec3 a = corner_a - p, b = corner_b - p, c = corner_c - p;
    // van Oosterom and Strackee (1983): tan(Omega / 2) = a . (b x c) / (la lb lc + ...). atan2
    // keeps the right branch where the denominator is negative, for points near the triangle; Omega
    // / (4 pi) is atan2 / (2 pi).
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    const double below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    return std::atan2(a.dot(b.cross(c)), below) / (2.0 * std::numbers::pi);
}

WindingNumber::WindingNumber(const TriangleMesh& mesh) {
    if (mesh.triangles.empty()) return;
    std::vector<std::int32_t> order(mesh.triangles.size());
    std::iota(order.begin(), order.end(), 0);
    std::vector<Vec3> centers;
    centers.reserve(order.size());
    for (std::size_t t = 0; t < order.size(); ++t)
        centers.push_back((mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0);
    // A tree over the centres; triangles are stored in its order, so that those of one node lie
    // side by side in memory.
    nodes_.reserve(order.size());
    build(mesh, order, centers, 0, static_cast<std::int32_t>(order.size()));
    corners_.reserve(order.size());
    for (const std::int32_t t : order) {
        const auto tt = static_cast<std::size_t>(t);
        corners_.push_back({mesh.corner(tt, 0), mesh.corner(tt, 1), mesh.corner(tt, 2)});
    }
}

std::int32_t WindingNumber::build(const TriangleMesh& mesh, std::vector<std::int32_t>& order,
                                  const std::vector<Vec3>& centers, std::int32_t first,
                                  std::int32_t count) {
    const auto index = nodes_.size();
    nodes_.emplace_back();
    const auto begin = order.begin() + first, end = begin + count;
    Eigen::AlignedBox3d box;
    Vec3 area = Vec3::Zero(), weighted = Vec3::Zero();
    double total = 0.0;
    for (auto t = begin; t != end; ++t) {
        const auto tt = static_cast<std::size_t>(*t);
        const Vec3 vector = mesh.area_vector(tt);
        area += vector;
        weighted += vector.norm() * centers[tt];
        total += vector.norm();
        box.extend(centers[tt]);
    }
    // The dipole of the node (Barill et al. 2018, first order): the sum of the area vectors, at the
    // centre weighted by area, which is where the neglected terms are small.
    Node& node = nodes_[index];
    node.area = area;
    node.center = total > 0.0 ? Vec3(weighted / total) : box.center();
    for (auto t = begin; t != end; ++t)
        for (int k = 0; k < 3; ++k)
            node.reach = std::max(
                node.reach, (mesh.corner(static_cast<std::size_t>(*t), k) - node.center).norm());
    if (count <= kLeafSize) {
        node.first = first;
        node.count = count;
        return static_cast<std::int32_t>(index);
    }
    int axis = 0;
    box.sizes().maxCoeff(&axis);
    const std::int32_t half = count / 2;
    // ties by triangle number, so that equal meshes give equal trees
    std::nth_element(begin, begin + half, end, [&](std::int32_t l, std::int32_t r) {
        const double cl = centers[static_cast<std::size_t>(l)][axis];
        const double cr = centers[static_cast<std::size_t>(r)][axis];
        return cl < cr || (cl == cr && l < r);
    });
    build(mesh, order, centers, first, half);
    const std::int32_t right = build(mesh, order, centers, first + half, count - half);
    nodes_[index].right = right;
    return static_cast<std::int32_t>(index);
}

bool WindingNumber::contains(const Vec3& p) const {
    for (const double beta : kBetas) {
        const double w = std::abs(at(p, beta));
        // |w|, not w: a mesh that is inside out has the same inside
        if (std::abs(w - 0.5) > kError / (beta * beta)) return w > 0.5;
    }
    return std::abs(at(p, std::numeric_limits<double>::infinity())) > 0.5;
}

double WindingNumber::at(const Vec3& p, double beta) const {
    if (nodes_.empty()) return 0.0;
    double sum = 0.0;
    // halving gives a depth of log2(T), and one entry waits per level
    std::int32_t stack[64];
    int depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
        const std::int32_t index = stack[--depth];
        const Node& node = nodes_[static_cast<std::size_t>(index)];
        // far from a node its triangles act as one dipole, area vector . r / (4 pi r^3) (Barill et
        // al. 2018)
        const Vec3 to = node.center - p;
        const double distance_sq = to.squaredNorm();
        if (distance_sq > beta * beta * node.reach * node.reach) {
            sum +=
                node.area.dot(to) / (4.0 * std::numbers::pi * distance_sq * std::sqrt(distance_sq));
            continue;
        }
        if (node.count == 0) {
            stack[depth++] = node.right;
            stack[depth++] = index + 1;
            continue;
        }
        for (std::int32_t k = node.first; k < node.first + node.count; ++k) {
            const auto& corner = corners_[static_cast<std::size_t>(k)];
            sum += solid_angle(p, corner[0], corner[1], corner[2]);
        }
    }
    return sum;
}

}  // namespace ice
