// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/shape/surface_blocks.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace ice {

namespace {

constexpr std::size_t kLanes = FacetBlock::kLanes;

void put(const Facet& facet, std::size_t lane, FacetBlock& block) {
    for (int d = 0; d < 3; ++d) {
        block.area[d][lane] = facet.area[d];
        for (int k = 0; k < 3; ++k) block.corner[k][d][lane] = facet.corner[k][d];
    }
}

}  // namespace

Facet make_facet(const Vec3& a, const Vec3& b, const Vec3& c) {
    return {{a, b, c}, 0.5 * (b - a).cross(c - a)};
}

FacetBlocks::FacetBlocks(std::span<const Facet> facets) : count(facets.size()) {
    // Rounded up: kernels read whole blocks. An empty surface has no block, and the loop below no
    // last facet to copy.
    blocks.resize((count + kLanes - 1) / kLanes);
    for (std::size_t k = 0; k < kLanes * blocks.size(); ++k) {
        // copies of the last facet without an area add nothing to a sum
        Facet facet = facets[std::min(k, count - 1)];
        if (k >= count) facet.area.setZero();
        put(facet, k % kLanes, blocks[k / kLanes]);
    }
}

Facet FacetBlocks::operator[](std::size_t k) const {
    const FacetBlock& block = blocks[k / kLanes];
    const std::size_t lane = k % kLanes;
    const auto vector = [&](const double(&of)[3][kLanes]) {
        return Vec3(of[0][lane], of[1][lane], of[2][lane]);
    };
    return {{vector(block.corner[0]), vector(block.corner[1]), vector(block.corner[2])},
            vector(block.area)};
}

}  // namespace ice
