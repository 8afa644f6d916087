// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// A sphere for the search, with the extents of the patch that it represents.
struct SearchSphere {
    Vec3 center;            ///< [m]
    double normal_extent;   ///< along a contact normal, NormalCone::apex_distance [m]
    double tangent_extent;  ///< across it, NormalCone::tangent_extent [m]
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
/// Floats: the search may find too much, never too little, so its user adds the error of rounding
/// to floats (kFloatShare) to all distances; the pairs found are measured in double precision.
struct SphereBlocks {
    /// Spheres in a group [-]: the lanes of the widest vector of floats. Smaller groups have
    /// tighter boxes, and more of them to test.
    static constexpr std::size_t kGroup = 16;
    /// Distances between floats are right to this share [-] of the coordinates' size, some ten
    /// units in the last place. Less could miss contacts, more finds spheres in vain.
    static constexpr float kFloatShare = 1e-6f;

    // per sphere; the last group is filled up with spheres that are far from everything
    std::vector<float> x, y, z;                        ///< centre, body axes [m]
    std::vector<float> normal_extent, tangent_extent;  ///< SearchSphere's [m]
    std::vector<float> own;                            ///< hypot(normal_extent, tangent_extent) [m]
    std::vector<std::int32_t> id;  ///< the shape's number of the sphere; -1 in the fill

    BoxRows groups;         ///< of the centres of each group
    BoxRows clusters;       ///< of 16 groups each; both rows are filled up to 16 with empty boxes
    std::size_t count = 0;  ///< spheres
    std::size_t group_count = 0;
    FloatBox box{};  ///< of all centres
    /// Largest extents of all spheres [m].
    float largest_normal_extent = 0.0f, largest_tangent_extent = 0.0f, largest_own = 0.0f;
    float size = 0.0f;  ///< largest coordinate of a centre [m]

    SphereBlocks() = default;
    explicit SphereBlocks(std::span<const SearchSphere> spheres);
};

}  // namespace ice
