// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/manifold/make_centre_contacts.hpp"

#include <algorithm>

namespace ice {

namespace {

// An edge that presses sideways still has some area, as a share of its sphere's [-], so that no
// contact is without strength. More adds force on sides that slide along.
constexpr double kLeastFacingCentres = 0.05;

// Surface of an ice sphere as seen along the contact normal: with the mean normal m and the
// half-angle s of the faces that meet there, cos(s) m is the sphere's vector area per area.
double facing_area(const Shape& shape, std::int32_t k, const Vec3& outward) {
    const double facing = shape.spread_cos[k] * shape.normal[k].dot(outward);
    return shape.area[k] * std::max(facing, kLeastFacingCentres);
}

// Contacts per sphere of one side; of spheres not in contact the entry is not set.
void count_contacts(std::span<const Candidate> all, std::int32_t Candidate::*side,
                    std::size_t spheres, std::vector<std::int32_t>& out) {
    if (out.size() < spheres) out.resize(spheres);
    for (const Candidate& c : all) out[static_cast<std::size_t>(c.*side)] = 0;
    for (const Candidate& c : all) ++out[static_cast<std::size_t>(c.*side)];
}

}  // namespace

// Every pair of spheres is a contact, and shares of the surface are split. The point is midway
// between the surfaces, the gap small against the radii.
void make_centre_contacts(const PairView& view, std::span<const Candidate> candidates,
                          CentreContactsWork& work, Contact* out) {
    const bool ship = view.pair.a == static_cast<std::int32_t>(kShip);
    count_contacts(candidates, &Candidate::j, view.shape_b.center.size(), work.shared_b);
    // shares are the ice's: the hull's many spheres are not counted
    if (!ship) count_contacts(candidates, &Candidate::i, view.shape_a.center.size(), work.shared_a);
    const std::int32_t *contacts_of_a = work.shared_a.data(), *contacts_of_b = work.shared_b.data();
    std::vector<ContactPlace>& places = work.places;
    places.clear();
    for (const Candidate& c : candidates)
        places.push_back(place_of(view, c, std::uint64_t(c.i) << 32 | std::uint64_t(c.j)));
    sort_places(places);
    Contact* contact = out;
    for (const ContactPlace& place : places) {
        const Candidate& c = *place.candidate;
        const Vec3 inward = -c.gap.normal;
        // midway between the surfaces, from b's surface by half the gap
        const Vec3 surface = view.center_b(c.j) + view.shape_b.radius[c.j] * inward;
        fill_contact(view, place, surface + 0.5 * c.gap.gap * inward, *contact);
        contact->crushes_a = false;
        // A sphere with several contacts shares its area among them: no surface counts twice.
        // Between floes the smaller of both areas bounds the force.
        double area = facing_area(view.shape_b, c.j, view.rotation_ab.transpose() * inward) /
                      contacts_of_b[c.j];
        if (!ship)
            area =
                std::min(area, facing_area(view.shape_a, c.i, c.gap.normal) / contacts_of_a[c.i]);
        contact->patch = Patch{.share = area};
        ++contact;
    }
    order_equals(places, out);
}

}  // namespace ice
