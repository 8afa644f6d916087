// SPDX-License-Identifier: GPL-3.0-or-later
/// Depths by which solids overlap, measured without the contacts.
#pragma once

#include <vector>

#include "solver/narrow/find_contacts.hpp"
#include "solver/scene/bodies.hpp"

namespace ice {

/// A pair whose solids overlap deeper than its contacts show.
struct UnseenOverlap {
    std::int32_t a, b;
    double depth;  ///< deepest point less the contacts' own depth [m]
};

/// Overlaps found between all bodies; crushed ice is no overlap.
struct OverlapFound {
    double deepest = 0.0;               ///< of two solids [m]
    std::vector<UnseenOverlap> unseen;  ///< in the order of the pairs
};

/// Two bodies that share room.
struct PairOverlap {
    double depth = 0.0;         ///< of the deepest point of either one in the other [m]
    Vec3 point = Vec3::Zero();  ///< where that is, world axes [m]; of a depth above 0
    std::int32_t inside =
        -1;  ///< the body whose spheres' centres all lie in the other; -1: neither
};

// Overlaps by the bodies' meshes, without the contact finder: neither its pairs nor its gaps.
//
// Points of one body, its mesh's vertices and its spheres' seats as far as crushed, are tested in
// the other body, and the other way round. A point's depth is its distance from the nearest point
// of the other's mesh. An edge that crosses another edge between seats is missed by up to half a
// spacing.

/// All bodies that are close to each other, pairs of held ones left out.
/// @param contacts  of these poses or of those a step before, ordered by pair
OverlapFound measure_overlaps(const Scene& scene, const std::vector<Contact>& contacts);

/// The overlap of one pair, without its contacts.
PairOverlap measure_overlap(const Scene& scene, std::int32_t a, std::int32_t b);

/// Does a point [m] of the world's axes lie in a body's mesh?
bool is_inside(const Scene& scene, std::int32_t body, const Vec3& point);

}  // namespace ice
