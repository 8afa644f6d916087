// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/feature/deep_pair.hpp"

namespace ice {

namespace {

// Solids meet in their polygon, too, if they overlap by this much more than any contact of their
// spheres. The separating axis is exact: this is the depth that a hull's edge may reach in a
// floe's face between two spheres, 1 mm with spheres of 0.05 m. With half a radius a knuckle cut 26
// mm into a floe without a contact (docs/design-notes.md); less gives polygons without need.
constexpr double kLostShare = 0.02;  // of the ice's radius [-]

// Depth from which a seat counts, of the ice's largest radius [-]. Contacts that are found at this
// depth are pushed out of it and lost again: with half a radius pairs trembled at that depth for
// seconds (docs/design-notes.md); less checks more contacts against the meshes.
constexpr double kDeepShare = 0.1;

}  // namespace

double lost_slack(const PairView& view) { return kLostShare * view.shape_b.largest_radius; }

bool is_deep(const PairView& view, double apart) {
    return is_convex_pair(view) && apart < -lost_slack(view);
}

double deep_slack(const PairView& view) { return kDeepShare * view.shape_b.largest_radius; }

}  // namespace ice
