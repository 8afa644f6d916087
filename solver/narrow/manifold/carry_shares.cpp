// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/manifold/carry_shares.hpp"

#include <algorithm>
#include <limits>

#include "solver/narrow/feature/contact_polygon.hpp"
#include "solver/narrow/feature/gap_rule.hpp"
#include "solver/narrow/manifold/make_contacts.hpp"

namespace ice {

namespace {

Vec3 in_axes_of_a(const PairView& view, const Vec3& direction) {
    return view.scene.bodies.rotation[view.pair.a].transpose() * direction;
}

// A patch's part of the section across the axis [m2].
double section_of(const Contact& c, double lean) {
    return c.patch.depth > 0.0 ? lean * cut_area(c.patch, c.patch.depth) : 0.0;
}

// The hull's edge or corner in whose part of the section an ice sphere's share lies, seen along the
// axis: the nearest one, as far as its wings go.
Contact* edge_over(const PairView& view, std::span<Contact> contacts, std::int32_t ice,
                   const Vec3& axis) {
    const Shape& hull = view.shape_a;
    // the seat of the ice's sphere, in the hull's axes
    const Vec3 seat = view.rotation_ab * (view.shape_b.center[ice] +
                                          view.shape_b.radius[ice] * view.shape_b.normal[ice]) +
                      view.translation_ab;
    const auto beside = [&](const Contact& c) {
        return part_across(seat - view.support_a(c.sphere_a, axis), axis);
    };
    double least = std::numeric_limits<double>::infinity();
    Contact* nearest = nullptr;
    for (Contact& c : contacts) {
        // ice spheres on the hull's faces have their own sections; only the hull's edges
        // receive here
        if (incident_is_b(c)) continue;
        const double distance = beside(c).norm();
        if (distance >= least) continue;
        least = distance;
        nearest = &c;
    }
    if (nearest == nullptr) return nullptr;
    // Along an edge the nearest sphere's part ends where the next one's begins. Across it the
    // part ends where its wings end, seen along the contact's normal.
    const NormalCone& faces = hull.cone[nearest->sphere_a];
    Vec3 from_edge = beside(*nearest);
    if (faces.count == 2) from_edge = part_across(from_edge, faces.edge(0));
    const Patch& patch = nearest->patch;
    return from_edge.norm() < patch.wing * patch.spread_cos * patch.facing ? nearest : nullptr;
}

}  // namespace

void carry_shares(const PairView& view, std::vector<double>& carried, std::span<Contact> contacts) {
    const ConvexPiece &a = view.shape_a.convex, &b = view.shape_b.convex;
    if (view.pair.a != static_cast<std::int32_t>(kShip) || a.empty() || b.empty()) return;
    // `enough` is 0: of solids that overlap every axis is measured, of solids apart one that
    // separates them will do.
    const RelativePose pose{view.rotation_ab, view.translation_ab};
    const Vec3 axis = axis_normal(a, b, pose, find_axes(a, b, pose, 0.0));
    carried.assign(contacts.size(), 0.0);
    for (Contact& c : contacts) {
        if (!incident_is_b(c)) continue;
        const Vec3 n = in_axes_of_a(view, c.normal),
                   m = view.rotation_ab * -view.shape_b.normal[c.sphere_b];
        const double facing = m.dot(n), lean = n.dot(axis);
        // a share that faces away from the hull or from the axis has no part in the section
        if (facing <= 0.0 || lean <= 0.0) continue;
        // A (-n_j . s) / (n . s) of docs/method.md, section 3: the share's projection on the
        // separating axis, brought to the contact's normal.
        c.patch.share *= std::clamp(m.dot(axis) / (facing * lean), 1.0, 1.0 / (facing * facing));
        if (Contact* edge = edge_over(view, contacts, c.sphere_b, axis))
            carried[static_cast<std::size_t>(edge - contacts.data())] += section_of(c, lean);
    }
    for (std::size_t k = 0; k < contacts.size(); ++k) {
        if (carried[k] == 0.0) continue;
        // Area that the ice's spheres already cover is taken from the edge's own section, so
        // nothing counts twice.
        const double own =
            section_of(contacts[k], in_axes_of_a(view, contacts[k].normal).dot(axis));
        contacts[k].patch.share *= own > carried[k] ? 1.0 - carried[k] / own : 0.0;
    }
}

}  // namespace ice
