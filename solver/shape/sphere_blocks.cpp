// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/shape/sphere_blocks.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace ice {

namespace {

constexpr std::size_t kGroup = SphereBlocks::kGroup;
constexpr std::size_t kCluster = kGroup * kGroup;

// Place of the spheres that fill up the last group [m]: beyond any body, and squares of distances
// to it are still finite floats.
constexpr float kFarAway = 1e18f;

// Halves the widest side of the spheres' box again and again, always at whole groups and, as long
// as there are several, at whole clusters.
void sort_by_place(std::span<const SearchSphere> spheres, std::span<std::int32_t> order) {
    if (order.size() <= kGroup) return;
    Eigen::AlignedBox3d box;
    for (const std::int32_t k : order) box.extend(spheres[static_cast<std::size_t>(k)].center);
    int axis = 0;
    box.sizes().maxCoeff(&axis);
    const std::size_t unit = order.size() > kCluster ? kCluster : kGroup;
    const std::size_t units = (order.size() + unit - 1) / unit;
    const std::size_t half = std::max<std::size_t>(units / 2, 1) * unit;
    std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(half), order.end(),
                     [&](std::int32_t l, std::int32_t r) {
                         const double at_l = spheres[static_cast<std::size_t>(l)].center[axis];
                         const double at_r = spheres[static_cast<std::size_t>(r)].center[axis];
                         return at_l != at_r ? at_l < at_r : l < r;
                     });
    sort_by_place(spheres, order.first(half));
    sort_by_place(spheres, order.subspan(half));
}

// Boxes of every 16 rows of `in`, filled up to a multiple of 16 with boxes that hold nothing.
BoxRows box_every_16(const BoxRows& in, std::size_t rows) {
    BoxRows out;
    const std::size_t count = (rows + kGroup - 1) / kGroup;
    const std::size_t padded = (count + kGroup - 1) / kGroup * kGroup;
    for (int d = 0; d < 3; ++d) {
        out.low[d].assign(padded, kFarAway);
        out.high[d].assign(padded, -kFarAway);
        for (std::size_t k = 0; k < rows; ++k) {
            float &low = out.low[d][k / kGroup], &high = out.high[d][k / kGroup];
            low = std::min(low, in.low[d][k]);
            high = std::max(high, in.high[d][k]);
        }
    }
    return out;
}

}  // namespace

SphereBlocks::SphereBlocks(std::span<const SearchSphere> spheres) : count(spheres.size()) {
    std::vector<std::int32_t> order(count);
    std::iota(order.begin(), order.end(), 0);
    sort_by_place(spheres, order);

    // The last group is filled up with spheres far from everything: kernels need no remainder loop.
    group_count = (count + kGroup - 1) / kGroup;
    const std::size_t padded = group_count * kGroup;
    x.assign(padded, kFarAway);
    y = z = x;
    normal_extent.assign(padded, 0.0f);
    tangent_extent = own = normal_extent;
    id.assign(padded, -1);
    for (std::size_t k = 0; k < count; ++k) {
        const SearchSphere& s = spheres[static_cast<std::size_t>(order[k])];
        x[k] = static_cast<float>(s.center.x());
        y[k] = static_cast<float>(s.center.y());
        z[k] = static_cast<float>(s.center.z());
        normal_extent[k] = static_cast<float>(s.normal_extent);
        tangent_extent[k] = static_cast<float>(s.tangent_extent);
        own[k] = static_cast<float>(std::hypot(s.normal_extent, s.tangent_extent));
        id[k] = order[k];
        largest_normal_extent = std::max(largest_normal_extent, normal_extent[k]);
        largest_tangent_extent = std::max(largest_tangent_extent, tangent_extent[k]);
        largest_own = std::max(largest_own, own[k]);
        size = std::max({size, std::abs(x[k]), std::abs(y[k]), std::abs(z[k])});
    }
    if (count == 0) return;
    // Two levels of boxes: most of a hull's 16 x 16 clusters are ruled out by one test each.
    const BoxRows points{{x, y, z}, {x, y, z}};
    groups = box_every_16(points, count);
    clusters = box_every_16(groups, group_count);
    for (int d = 0; d < 3; ++d) {
        box.low[d] = *std::min_element(clusters.low[d].begin(), clusters.low[d].end());
        box.high[d] = *std::max_element(clusters.high[d].begin(), clusters.high[d].end());
    }
}

}  // namespace ice
