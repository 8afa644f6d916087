// SPDX-License-Identifier: GPL-3.0-or-later
/// Contacts from the polygon of two convex solids: for floes that cannot be crushed the only
/// contacts; for pairs so deep that their spheres have passed each other, additional ones.
#pragma once

#include <span>

#include "solver/narrow/feature/contact_polygon.hpp"
#include "solver/narrow/feature/pair_view.hpp"
#include "solver/narrow/feature/part_polygons.hpp"
#include "solver/narrow/manifold/contact.hpp"
#include "solver/narrow/manifold/contact_rule.hpp"

namespace ice {

/// Are the contacts of this pair the corners of the polygons in which the two solids meet? Floes
/// that are convex and cannot be crushed, and pieces of level ice, which are crushed only by the
/// ship and at held ice: then no contact needs a sphere's share of the surface.
bool meets_in_polygon(const Scene& scene, BodyPair pair, const ContactRule& rule);

/// Finds their contacts within `most` [m], at most four; no corners where every gap is wider.
/// @pre both convex @param axes  of the two solids, all kinds
/// @param polygon  its old content is dropped, its memory kept
void find_polygon(const PairView& view, const SeparatingAxes& axes, double most, ClippingWork& work,
                  ContactPolygon& polygon);

/// Makes contacts of corners, in their order. Between floes that cannot be crushed they have no
/// spheres and no share; else those of the nearest spheres, b's ice being crushed.
/// @param out  room for as many
void make_polygon_contacts(const PairView& view, const ContactRule& rule,
                           std::span<const MetCorner> corners, Contact* out);

/// The polygon in which a deep pair meets, within `most` [m], where no contact of its spheres is as
/// deep: the least of their gaps is more than the separation by lost_slack, crushed ice left out;
/// no corners otherwise.
/// @pre is_deep() @param found  the contacts of the spheres
/// @param polygon  its old content is dropped, its memory kept
void find_lost_polygon(const PairView& view, std::span<const Candidate> found, double most,
                       ClippingWork& work, ContactPolygon& polygon);

}  // namespace ice
