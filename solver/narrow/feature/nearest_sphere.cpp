// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/feature/nearest_sphere.hpp"

#include <algorithm>
#include <limits>
#include <tuple>

namespace ice {

namespace {

// The squared distance of a point from a group's box, less the largest rounding of floats [m2].
double distance_sq(const SphereBlocks& blocks, std::size_t g, const Vec3& p, double rounding) {
    double sum = 0.0;
    for (int d = 0; d < 3; ++d) {
        const double low = static_cast<double>(blocks.groups.low[d][g]) - rounding,
                     high = static_cast<double>(blocks.groups.high[d][g]) + rounding;
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
    for (std::size_t g = 0; g < blocks.group_count; ++g) {
        // a group whose box is farther than the best sphere has none that is nearer
        if (distance_sq(blocks, g, point, rounding) > std::get<0>(least)) continue;
        for (std::size_t lane = 0; lane < SphereBlocks::kGroup; ++lane) {
            const std::int32_t k = blocks.id[g * SphereBlocks::kGroup + lane];
            if (k >= 0) least = std::min(least, key(k));
        }
    }
    return std::get<2>(least);
}

}  // namespace ice
