// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/fill/nearest_points.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace ice {

namespace {

constexpr std::int32_t kLeafSize = 8;

}  // namespace

NearestPoints::NearestPoints(std::span<const Vec3> points) {
    points_.reserve(points.size());
    for (std::size_t k = 0; k < points.size(); ++k)
        points_.push_back({points[k], static_cast<std::int32_t>(k)});
    nodes_.reserve(points.size() / 2 + 1);
    build(0, static_cast<std::int32_t>(points.size()));
}

std::int32_t NearestPoints::build(std::int32_t first, std::int32_t count) {
    const auto index = static_cast<std::int32_t>(nodes_.size());
    nodes_.emplace_back();
    if (count <= kLeafSize) {
        nodes_.back().first = first;
        nodes_.back().count = count;
        return index;
    }
    Eigen::AlignedBox3d box;
    for (std::int32_t k = first; k < first + count; ++k)
        box.extend(points_[static_cast<std::size_t>(k)].at);
    int axis = 0;
    box.sizes().maxCoeff(&axis);
    const std::int32_t half = count / 2;
    const auto begin = points_.begin() + first;
    std::nth_element(begin, begin + half, begin + count, [&](const Point& l, const Point& r) {
        return l.at[axis] < r.at[axis] || (l.at[axis] == r.at[axis] && l.index < r.index);
    });
    const double split = (begin + half)->at[axis];
    build(first, half);
    const std::int32_t right = build(first + half, count - half);
    Node& node = nodes_[static_cast<std::size_t>(index)];
    node.split = split;
    node.axis = axis;
    node.right = right;
    return index;
}

void NearestPoints::search(std::int32_t at, const Vec3& p, double& best_sq,
                           std::int32_t& best) const {
    const Node& node = nodes_[static_cast<std::size_t>(at)];
    if (node.right == 0) {
        for (std::int32_t k = node.first; k < node.first + node.count; ++k) {
            const Point& point = points_[static_cast<std::size_t>(k)];
            const double sq = (point.at - p).squaredNorm();
            if (sq > best_sq || (sq == best_sq && point.index > best)) continue;
            best_sq = sq;
            best = point.index;
        }
        return;
    }
    const double beyond = p[node.axis] - node.split;
    search(beyond < 0.0 ? at + 1 : node.right, p, best_sq, best);
    // the other half only where it can hold one as near; ties are looked at
    if (beyond * beyond <= best_sq) search(beyond < 0.0 ? node.right : at + 1, p, best_sq, best);
}

NearestPoints::Nearest NearestPoints::nearest(const Vec3& p) const {
    double best_sq = std::numeric_limits<double>::infinity();
    std::int32_t best = -1;
    search(0, p, best_sq, best);
    return {best, std::sqrt(best_sq)};
}

}  // namespace ice
