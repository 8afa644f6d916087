// SPDX-License-Identifier: GPL-3.0-or-later
/// From which depth on the spheres of two solids may have lost each other.
#pragma once

#include "solver/narrow/feature/pair_view.hpp"

namespace ice {

/// Are both bodies convex solids (Shape::convex)? Then the separating axis gives their depth.
inline bool is_convex_pair(const PairView& view) {
    return !view.shape_a.convex.empty() && !view.shape_b.convex.empty();
}

/// Overlap of two convex solids [m], beyond that of their spheres' contacts, from which they meet
/// in their polygon, too: a fiftieth of the largest radius of b's spheres.
double lost_slack(const PairView& view);

/// Do two convex solids overlap by more than lost_slack?
///
/// Their spheres may miss it: they pass each other from about two radii on, and a hull's edge can
/// cut into a floe's face between two of them.
/// @param apart  [m] their separation (separation.hpp)
bool is_deep(const PairView& view, double apart);

/// Depth [m] from which a seat without a contact near it becomes a contact: a tenth of the largest
/// radius of b's spheres.
double deep_slack(const PairView& view);

}  // namespace ice
