// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "solver/narrow/contact_polygon.hpp"
#include "solver/narrow/pair_view.hpp"

namespace ice {

/// Do two convex solids overlap so far that their spheres may have passed each other?
///
/// Spheres find each other within about two radii; deeper pairs are found as solids.
/// @param apart  [m] their separation (separation.hpp)
bool is_deep(const PairView& view, double apart);

/// The polygon in which a deep pair meets, within `most` [m], where its spheres' contacts do not
/// tell of it: the least of their gaps is more than the separation by half a radius, crushed ice
/// left out; null otherwise. Valid until the thread's next question.
/// @pre is_deep() @param found  the contacts of the spheres
const ContactPolygon* find_lost_polygon(const PairView& view, std::span<const Candidate> found,
                                        double most);

/// The surface sphere nearest to a point in the shape's axes.
std::int32_t nearest_sphere(const Shape& shape, const Vec3& point);

}  // namespace ice
