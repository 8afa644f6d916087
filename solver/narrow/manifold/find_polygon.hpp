// SPDX-License-Identifier: GPL-3.0-or-later
/// Contacts from the polygon of two convex solids: of two floes, or a hull and rigid ice, the only
/// contacts; of a floe that the hull crushes, so deep that their spheres have passed each other,
/// additional ones.
#pragma once

#include <span>

#include "solver/narrow/feature/contact_polygon.hpp"
#include "solver/narrow/feature/pair_view.hpp"
#include "solver/narrow/feature/part_polygons.hpp"
#include "solver/narrow/feature/section_area.hpp"
#include "solver/narrow/feature/solid_pair.hpp"
#include "solver/narrow/manifold/contact.hpp"
#include "solver/narrow/manifold/contact_rule.hpp"

namespace ice {

/// How the contacts of a pair are found.
PairRule pair_rule_of(const Scene& scene, BodyPair pair, const ContactRule& rule);

/// Finds the corners within `most` [m], at most four; none where every gap is wider.
/// @param axes  of the two solids, all kinds
/// @param step  corners that are open at its begin and end, if nothing hinders the bodies, are the
///              first to be left out
/// @param polygon  its old content is dropped, its memory kept
void find_polygon(const SolidPair& solids, const SeparatingAxes& axes, double most,
                  const PairStep& step, ClippingWork& work, ContactPolygon& polygon);

/// Appends the corners of a polygon that presses on ice that can be crushed. Corners that touch
/// share the section of the two solids (section_area) equally; corners that are open have a share
/// of the same size, for the case that they close within the step. Crushing cuts the solid that is
/// more slender there (slice_area), and b's of two equal ones. It loses its corner or edge; the
/// other solid keeps its face.
void append_pressed(const SolidPair& solids, const ContactPolygon& polygon, SectionWork& work,
                    std::vector<MetCorner>& out);

/// Makes contacts of corners, in their order. Of solids only the ship has a sphere, the nearest
/// one, which records the load. The others have the spheres nearest to them, with their shares,
/// b's ice being crushed.
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
