// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// A sphere as the search sees it: where it is and how far from there its surface may be.
struct SearchSphere {
    Vec3 center;   ///< [m]
    double along;  ///< along a contact normal: Faces::corner [m]
    double aside;  ///< and across it: Faces::aside [m]
};

/// Axis-aligned box [m].
struct FloatBox {
    float low[3], high[3];
};

/// Axis-aligned boxes beside each other in memory [m].
struct BoxRows {
    std::vector<float> low[3], high[3];

    std::size_t size() const { return low[0].size(); }
};

/// The surface spheres of a shape in groups of 16 neighbours, for the search of near spheres.
///
/// Floats: the search may find too much, never too little, so its user adds what rounding to
/// floats costs (kFloatShare) to all distances; what it found is measured in double precision.
struct SphereBlocks {
    static constexpr std::size_t kGroup = 16;
    /// Distances between floats are right to this share of the coordinates' size.
    static constexpr float kFloatShare = 1e-6f;

    // per sphere; the last group is filled up with spheres that are far from everything
    std::vector<float> x, y, z;       ///< centre, body axes [m]
    std::vector<float> along, aside;  ///< SearchSphere's [m]
    std::vector<float> own;           ///< hypot(along, aside) [m]
    std::vector<std::int32_t> id;     ///< the shape's number of the sphere; -1 in the fill

    BoxRows groups;         ///< of the centres of each group
    BoxRows clusters;       ///< of 16 groups each; both rows are filled up to 16 with empty boxes
    std::size_t count = 0;  ///< spheres
    std::size_t group_count = 0;
    FloatBox box{};  ///< of all centres
    float largest_along = 0.0f, largest_aside = 0.0f, largest_own = 0.0f;
    float size = 0.0f;  ///< largest coordinate of a centre [m]

    SphereBlocks() = default;
    explicit SphereBlocks(std::span<const SearchSphere> spheres);
};

}  // namespace ice
