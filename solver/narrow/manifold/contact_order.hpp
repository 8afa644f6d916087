// SPDX-License-Identifier: GPL-3.0-or-later
/// Common parts of contacts under both rules: their order within a pair, in which the solver takes
/// them (its answer depends on it), and most of their members.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/narrow/feature/pair_view.hpp"
#include "solver/narrow/manifold/contact.hpp"

namespace ice {

/// A candidate's place in the order, as far as its spheres decide it. Candidates and contacts are
/// large, these are moved instead.
struct ContactPlace {
    std::uint64_t ranks;  ///< Shape::mirror_rank of a's sphere, then of b's
    std::uint64_t key;    ///< Contact::key
    const Candidate* candidate;
};

inline ContactPlace place_of(const PairView& view, const Candidate& c, std::uint64_t key) {
    const auto a = static_cast<std::uint32_t>(view.shape_a.mirror_rank[c.i]);
    const auto b = static_cast<std::uint32_t>(view.shape_b.mirror_rank[c.j]);
    return {(std::uint64_t{a} << 32) | b, key, &c};
}

/// Sets all of a contact but its patch and `crushes_a`. @param meeting  its point, in a's axes [m]
inline void fill_contact(const PairView& view, const ContactPlace& place, const Vec3& meeting,
                         Contact& out) {
    const Candidate& c = *place.candidate;
    const Mat3& rotation = view.scene.bodies.rotation[view.pair.a];
    out.a = view.pair.a;
    out.b = view.pair.b;
    out.sphere_a = c.i;
    out.sphere_b = c.j;
    out.key = place.key;
    out.point = rotation * meeting + view.scene.bodies.position[view.pair.a];
    out.normal = rotation * c.gap.normal;
    out.gap = c.gap.gap;
    const bool ship = view.pair.a == static_cast<std::int32_t>(kShip);
    out.region = ship ? view.shape_a.region.at(c.i, c.gap.normal) : -1;
}

/// Sorts by the spheres' ranks alone; order_equals() decides among equal ones.
void sort_places(std::vector<ContactPlace>& places);

/// Brings the contacts made at these places, sorted, into their order: spheres and their mirror
/// images have the same ranks, and of their contacts gap and place decide.
/// @param first  of the contacts, as many as places
void order_equals(const std::vector<ContactPlace>& places, Contact* first);

}  // namespace ice
