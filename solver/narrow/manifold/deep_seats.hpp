// SPDX-License-Identifier: GPL-3.0-or-later
/// Contacts of bodies that lie deep in each other and are not both convex: hulls, cusps.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/narrow/feature/pair_view.hpp"
#include "solver/narrow/manifold/contact.hpp"
#include "solver/narrow/manifold/contact_rule.hpp"
#include "solver/narrow/neighbours/pair_cache.hpp"

namespace ice {

/// A seat of one body that lies deep in the other's solid.
struct DeepSeat {
    std::int32_t sphere;  ///< number of the sphere whose seat it is
    bool of_b;            ///< of b in a's solid; else of a in b's
    std::int32_t facing;  ///< the other body's sphere at `foot`
    Vec3 seat, foot;      ///< the seat, and the end of its way out; a's axes [m]
    Vec3 normal;          ///< unit, from a to b, along seat - foot; a's axes
    double gap;           ///< minus the depth of its way out (way_out.hpp) [m]
};

/// Appends the seats that may lie deeper than deep_slack while the bodies move by at most `skin`
/// [m] relative to each other: {-1, sphere} is one of b, {sphere, -1} one of a. None in 2D and for
/// two convex solids.
/// @param apart  [m] the separation of the bodies
/// @returns how far they may move before one lies so deep, at most `skin` [m]; not above 0 while
/// one does, crushed ice counted as if it were whole
double list_near_seats(const PairView& view, double apart, double skin,
                       std::vector<SpherePair>& out);

/// Finds the seats of either body that lie in the other's solid and are deeper than every contact
/// within a patch radius by more than deep_slack. Seats whose direction differs from the deepest
/// one's by more than 60 degrees are left out.
///
/// Depth and direction are those of the way out of the other body: exact for any closed solid, but
/// the shortest path out is the wrong one for a seat beyond the middle of a body. The order of
/// `out` is by place, mirror images about y = 0 alike.
///
/// @param near   of list_near_seats(), with a skin of at least the motion since then
/// @param found  contacts that the spheres gave @param out  its old content is dropped
void find_deep_seats(const PairView& view, std::span<const SpherePair> near,
                     std::span<const Candidate> found, std::vector<DeepSeat>& out);

/// Makes their contacts: the patch is that of the seat, or of the ice that a hull's seat is in.
/// @param seats  of find_deep_seats(), in their order @param out  room for as many
void make_seat_contacts(const PairView& view, const ContactRule& rule,
                        std::span<const DeepSeat> seats, Contact* out);

}  // namespace ice
