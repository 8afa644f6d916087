// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/formats/sphere_set.hpp"
#include "common/formats/spheres_report.hpp"

namespace ice {

/// Where the spheres end short of the solid's forward end (stem), aft end (stern) or bottom (keel)
/// by more than half a radius: sets report.cut_back, at most one line an end, the deepest cut with
/// the range in which it is more than that.
///
/// At levels a quarter of a radius or more apart the foremost and aftmost points of the solid's
/// section are held against the foremost and aftmost points of the spheres' sections; likewise the
/// lowest points at stations along x. Levels are those of the ice belt, or without a draught all
/// but a radius at top and bottom, where an edge all round is cut whatever its shape; stations all
/// but a radius at both ends. A section that no sphere reaches is cut back by its whole extent. Of
/// the levels within half a spacing the least cut counts, so that a dip between neighbouring
/// spheres is none.
/// @pre set.mesh, centers, radii and surface_count are set. A 2D set gets no line.
/// Cost O(levels x T).
void find_cut_back(const SphereSet& set, SpheresReport& report);

}  // namespace ice
