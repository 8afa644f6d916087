// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/manifold/find_polygon.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/assert.hpp"
#include "solver/narrow/feature/deep_pair.hpp"
#include "solver/narrow/feature/nearest_sphere.hpp"
#include "solver/narrow/manifold/make_contacts.hpp"

namespace ice {

bool meets_in_polygon(const Scene& scene, BodyPair pair, const ContactRule& rule) {
    if (rule.normal != NormalRule::surface) return false;
    if (pair.a == static_cast<std::int32_t>(kShip))
        return false;  // the loads are recorded by its spheres
    const auto meets = [&](std::int32_t i) {
        const Shape& shape = scene.shapes[static_cast<std::size_t>(scene.bodies.shape[i])];
        return rule.crushes ? !shape.parts.empty() : !shape.convex.empty();
    };
    return meets(pair.a) && meets(pair.b);
}

void find_polygon(const PairView& view, const SeparatingAxes& axes, double most, ClippingWork& work,
                  ContactPolygon& polygon) {
    ICE_ASSERT(is_convex_pair(view));
    make_contact_polygon(view.shape_a.convex, view.shape_b.convex,
                         {view.rotation_ab, view.translation_ab}, axes, most, work, polygon);
    reduce_polygon(kManifoldCorners, polygon);
    std::sort(
        polygon.corners.begin(), polygon.corners.end(),
        [](const PolygonCorner& l, const PolygonCorner& r) { return place_key(l) < place_key(r); });
}

void make_polygon_contacts(const PairView& view, const ContactRule& rule,
                           std::span<const MetCorner> corners, Contact* out) {
    const Mat3& rotation = view.scene.bodies.rotation[view.pair.a];
    const bool ship = view.pair.a == static_cast<std::int32_t>(kShip);
    const bool rigid = meets_in_polygon(view.scene, view.pair, rule);
    for (const auto& [corner, normal] : corners) {
        Contact& contact = *out++;
        contact.a = view.pair.a;
        contact.b = view.pair.b;
        contact.sphere_a = contact.sphere_b = -1;
        // The warm start finds a corner again by the two features that meet in it.
        // No sphere has the first bit, and a deep seat has the second one, too.
        contact.key = std::uint64_t{1} << 63 | corner.id;
        contact.point = rotation * corner.point + view.scene.bodies.position[view.pair.a];
        contact.normal = rotation * normal;
        contact.gap = corner.gap;
        contact.patch = Patch{};
        contact.patch.depth = -corner.gap;
        contact.region = -1;
        contact.crushes_a = false;
        if (rigid) continue;
        // Crushing and regions need spheres: those nearest to the corner lend share and patch.
        contact.sphere_a = nearest_sphere(view.shape_a, corner.point);
        contact.sphere_b = nearest_sphere(view.shape_b, view.to_b(corner.point));
        if (ship) contact.region = view.shape_a.region.at(contact.sphere_a, normal);
        // the ice that was crushed there is left out; depth counts from its old surface
        contact.gap += crushed_depth(view, contact.sphere_b, normal);
        contact.patch = ice_patch(view, contact.sphere_b, normal, contact.gap);
    }
}

void find_lost_polygon(const PairView& view, std::span<const Candidate> found, double most,
                       ClippingWork& work, ContactPolygon& polygon) {
    ICE_ASSERT(is_convex_pair(view));
    polygon.corners.clear();
    // 0 as `enough`: the solids overlap, and of these all axes are measured
    const SeparatingAxes axes = find_axes(view.shape_a.convex, view.shape_b.convex,
                                          {view.rotation_ab, view.translation_ab}, 0.0);
    double least = 0.0;
    // A polygon is needed only if no sphere's contact is as deep as the solids, less what was
    // crushed and the slack.
    for (const Candidate& c : found) least = std::min(least, c.gap.gap);
    const double crushed =
        view.scene.crushed.deepest_of(view.pair.a) + view.scene.crushed.deepest_of(view.pair.b);
    if (axes.widest() + crushed + lost_slack(view) < least)
        find_polygon(view, axes, most, work, polygon);
}

}  // namespace ice
