// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "common/formats/sphere_set.hpp"
#include "common/formats/spheres_report.hpp"
#include "common/geometry/surface_tree.hpp"
#include "preprocess/fill/survey.hpp"

namespace ice {

/// Measures how well a sphere set represents its solid, independently of how it was made.
///
/// - protrusion: how far the worst surface sphere reaches beyond the surface;
/// - covering radius: over places where a sphere of the set's radius can touch, the largest
///   distance from its centre to the nearest surface sphere that covers it
///   (SphereFinder::covering): the samples, and a climb from the 512 worst;
/// - gap: from surface samples to the sphere they belong to, by share of the area;
/// - normal error: between the surface and the stored normal of the nearest sphere, over the same
///   samples as the covering radius, on faces (spread below 5 degrees);
/// - thin features: connected places, where no sphere fits, whose gap exceeds 2.5 radii (more where
///   the spacing is wide, since the nearest sphere then lies aside);
/// - unfitted share: of the wetted surface (all of it where no draught is given), where no sphere
///   can touch and the gap exceeds half a radius;
/// - gaps in the ice belt, where report.belt is given.
///
/// @param sights  of survey_surface, one per sample; @param half  as there
void measure_certificate(const SurfaceTree& tree, const SphereFinder& finder,
                         const std::vector<Sight>& sights, bool half, const SphereSet& set,
                         SpheresReport& report);

}  // namespace ice
