// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "solver/narrow/feature/pair_view.hpp"
#include "solver/narrow/manifold/contact.hpp"
#include "solver/narrow/manifold/contact_order.hpp"

namespace ice {

/// Work memory of make_contacts, which keeps its capacity between pairs.
struct ContactsWork {
    std::vector<ContactPlace> places;
    std::vector<double> carried;  ///< of carry_shares
};

/// Makes contacts of a pair's candidates under the rule "surface", in the order that ContactFinder
/// gives them: points, patches, keys and hull regions. @param out  room for as many
/// @pre the candidates of an incident sphere are adjacent (reduce_manifold)
void make_contacts(const PairView& view, std::span<const Candidate> candidates, ContactsWork& work,
                   Contact* out);

/// Is b's sphere the incident one? @param c  one of make_contacts(): other keys have no such bit
inline bool incident_is_b(const Contact& c) { return (c.key >> 32 & 1) != 0; }

/// Depth by which contact along the unit vector n, from a to b in a's axes, has crushed b's sphere
/// j [m]; at least 0, and 0 for a whole body.
double crushed_depth(const PairView& view, std::int32_t j, const Vec3& n);

/// The patch of b's sphere j behind a contact along n with this gap [m]. Its depth counts from the
/// uncrushed surface, so that a notch keeps its resistance.
Patch ice_patch(const PairView& view, std::int32_t j, const Vec3& n, double gap);
/// The patch of a's sphere i, a being a floe.
Patch patch_of_a(const PairView& view, std::int32_t i, const Vec3& n, double gap);

}  // namespace ice
