// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/feature/nearest_sphere.hpp"

#include <algorithm>
#include <limits>
#include <tuple>

namespace ice {

namespace {

// The squared distance of a point from box k, less the largest rounding of floats [m2].
double distance_sq(const BoxRows& boxes, std::size_t k, const Vec3& p, double rounding) {
    double sum = 0.0;
    for (int d = 0; d < 3; ++d) {
        const double low = static_cast<double>(boxes.low[d][k]) - rounding,
                     high = static_cast<double>(boxes.high[d][k]) + rounding;
        const double off = std::max({low - p[d], p[d] - high, 0.0});
        sum += off * off;
    }
    return sum;
}

}  // namespace

std::int32_t nearest_sphere(const Shape& shape, const Vec3& point) {
    const SphereBlocks& blocks = shape.blocks;
    // Distance decides, then the mirror rank: mirror images choose mirrored spheres.
    const auto key = [&](std::int32_t k) {
        const auto row = static_cast<std::size_t>(k);
        return std::tuple((shape.center[row] - point).squaredNorm(), shape.mirror_rank[row], k);
    };
    const double rounding = static_cast<double>(SphereBlocks::kFloatShare * blocks.size);
    auto least = std::tuple(std::numeric_limits<double>::infinity(), std::int32_t{0}, 0);
    // a box that is farther than the best sphere has none that is nearer
    const auto may_be_nearer = [&](const BoxRows& boxes, std::size_t k) {
        return distance_sq(boxes, k, point, rounding) <= std::get<0>(least);
    };
    const auto search_cluster = [&](std::size_t c) {
        const std::size_t end = std::min(blocks.group_count, (c + 1) * SphereBlocks::kGroup);
        for (std::size_t g = c * SphereBlocks::kGroup; g < end; ++g) {
            if (!may_be_nearer(blocks.groups, g)) continue;
            for (std::size_t lane = 0; lane < SphereBlocks::kGroup; ++lane) {
                const std::int32_t k = blocks.id[g * SphereBlocks::kGroup + lane];
                if (k >= 0) least = std::min(least, key(k));
            }
        }
    };
    const std::size_t clusters =
        (blocks.group_count + SphereBlocks::kGroup - 1) / SphereBlocks::kGroup;
    std::size_t nearest = 0;
    double least_sq = std::numeric_limits<double>::infinity();
    for (std::size_t c = 0; c < clusters; ++c) {
        const double sq = distance_sq(blocks.clusters, c, point, rounding);
        if (sq >= least_sq) continue;
        least_sq = sq;
        nearest = c;
    }
    search_cluster(nearest);
    for (std::size_t c = 0; c < clusters; ++c)
        if (c != nearest && may_be_nearer(blocks.clusters, c)) search_cluster(c);
    return std::get<2>(least);
}

}  // namespace ice
