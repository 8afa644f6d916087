// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "solver/narrow/contact.hpp"
#include "solver/narrow/contact_polygon.hpp"
#include "solver/narrow/contact_rule.hpp"
#include "solver/narrow/pair_view.hpp"

namespace ice {

/// Are the contacts of this pair the corners of the polygon in which the two solids meet? Floes
/// that are convex and cannot be crushed: then no contact needs a sphere's share of the surface.
bool meets_in_polygon(const Scene& scene, BodyPair pair, const ContactRule& rule);

/// Finds their contacts within `most` [m]; those of the last pair that the thread asked about are
/// forgotten. @pre meets_in_polygon @param axes  of the two solids, all kinds
const ContactPolygon& find_polygon(const PairView& view, const SeparatingAxes& axes, double most);

/// Makes contacts of a polygon's corners, in their order. Between floes that cannot be crushed they
/// have no spheres and no share; else those of the nearest spheres, b's ice giving way.
void emit_polygon(const PairView& view, const ContactRule& rule, const Vec3& normal,
                  std::span<const PolygonCorner> corners, Contact* out);

}  // namespace ice
