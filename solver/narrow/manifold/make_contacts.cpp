// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/manifold/make_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "solver/narrow/manifold/carry_shares.hpp"

namespace ice {

namespace {

Patch patch_of(const Shape& shape, std::int32_t k, const Vec3& outward) {
    Patch patch;
    patch.share = shape.area[k];
    patch.facing = shape.normal[k].dot(outward);
    patch.spread_cos = shape.spread_cos[k];
    patch.spread_sin = shape.spread_sin[k];
    patch.wing =
        shape.dimension == 2  // a share is a length: half of it on each side of the foot
            ? 0.5 * patch.share
            : wing_length(shape.radius[k], patch.share, patch.spread_cos, patch.spread_sin);
    // depth counts from an edge's corner, but on a face that leans from the sphere's foremost point
    const double facing = std::clamp(patch.facing, -1.0, 1.0);
    if (shape.cone[k].count == 0 && facing < patch.spread_cos) {
        const double lean = facing * patch.spread_cos +
                            std::sqrt(1.0 - facing * facing) * patch.spread_sin;  // cos(t - s)
        patch.foot = shape.radius[k] * (1.0 - lean);
    }
    return patch;
}

// The incident sphere's patch. If that is the hull's, the ice still is the body that crushes.
Patch incident_patch(const PairView& view, const Candidate& c) {
    const Vec3 out_a = c.gap.normal, out_b = view.rotation_ab.transpose() * -c.gap.normal;
    const bool ship = view.pair.a == static_cast<std::int32_t>(kShip);
    Patch patch = c.gap.reference_is_a ? patch_of(view.shape_b, c.j, out_b)
                                       : patch_of(view.shape_a, c.i, out_a);
    // Depth counts from the uncrushed surface: in a notch the section and so the bound (13)
    // stay as large as when it was cut.
    patch.depth = -c.gap.gap + (c.gap.reference_is_a || ship
                                    ? view.scene.crushed.depth_of(view.pair.b, c.j, out_b)
                                    : view.scene.crushed.depth_of(view.pair.a, c.i, out_a));
    return patch;
}

// Midway between two edges where they cross.
Vec3 crossing_point(const Feature& a, const Feature& b, const Gap& gap) {
    const Vec3 pa = support_point(a, gap.normal), pb = support_point(b, -gap.normal);
    const Vec3 ea = a.cone.edge(gap.edge_a), eb = b.cone.edge(gap.edge_b);
    const LineParameters at = closest_on_lines(pa, ea, pb, eb);
    return 0.5 * (pa + at.along_a * ea + pb + at.along_b * eb);
}

// The incident sphere decides where the bodies meet: midway between both surfaces at its support.
Vec3 meeting_point(const PairView& view, const Candidate& c) {
    // edges that cross: the closest points are not those of the support points
    if (c.gap.crossing) return crossing_point(view.sphere_a(c.i), view.sphere_b(c.j), c.gap);
    const double sign = c.gap.reference_is_a ? -1.0 : 1.0;
    const Vec3 outward = sign * c.gap.normal;
    const Vec3 surface =
        c.gap.reference_is_a ? view.support_b(c.j, outward) : view.support_a(c.i, outward);
    return surface + 0.5 * c.gap.gap * outward;
}

// Sets `places` to those of the candidates, with the keys of their contacts, sorted.
void find_places(const PairView& view, std::span<const Candidate> candidates,
                 std::vector<ContactPlace>& places) {
    places.clear();
    std::int32_t last_incident = -1, face = 0;
    for (const Candidate& c : candidates) {
        // an incident sphere slides over many reference spheres: the key is that sphere and its
        // face's rank, which last from step to step
        const std::int32_t incident = (c.incident() << 1) | (c.gap.reference_is_a ? 1 : 0);
        face = incident == last_incident ? face + 1 : 0;
        last_incident = incident;
        places.push_back(place_of(view, c, std::uint64_t(incident) << 32 | std::uint64_t(face)));
    }
    sort_places(places);
}

}  // namespace

double crushed_depth(const PairView& view, std::int32_t j, const Vec3& n) {
    return view.scene.crushed.depth_of(view.pair.b, j, view.rotation_ab.transpose() * -n);
}

Patch ice_patch(const PairView& view, std::int32_t j, const Vec3& n, double gap) {
    Patch patch = patch_of(view.shape_b, j, view.rotation_ab.transpose() * -n);
    patch.depth = -gap + crushed_depth(view, j, n);
    return patch;
}

Patch patch_of_a(const PairView& view, std::int32_t i, const Vec3& n, double gap) {
    Patch patch = patch_of(view.shape_a, i, n);
    patch.depth = -gap + view.scene.crushed.depth_of(view.pair.a, i, n);
    return patch;
}

void make_contacts(const PairView& view, std::span<const Candidate> candidates, ContactsWork& work,
                   Contact* out) {
    const bool ship = view.pair.a == static_cast<std::int32_t>(kShip);
    find_places(view, candidates, work.places);
    Contact* contact = out;
    for (const ContactPlace& place : work.places) {
        const Candidate& c = *place.candidate;
        fill_contact(view, place, meeting_point(view, c), *contact);
        // Of ship and floe the ice is crushed; of two floes the one whose sphere is incident.
        contact->crushes_a = !ship && !c.gap.reference_is_a;
        contact->patch = incident_patch(view, c);
        ++contact;
    }
    order_equals(work.places, out);
    carry_shares(view, work.carried, {out, candidates.size()});
}

}  // namespace ice
