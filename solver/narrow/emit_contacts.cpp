// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/emit_contacts.hpp"

#include <algorithm>
#include <cmath>

namespace ice {

namespace {

// An edge that presses sideways still has some area, so that no contact is without strength.
constexpr double kLeastFacing = 0.05;

// How deep contact has crushed a sphere along its side's outward direction [m].
double crushed_depth(const Scene& scene, std::int32_t body, std::int32_t sphere,
                     const Vec3& outward) {
    return std::max(0.0, -scene.crushed.recess_of(body, sphere).dot(outward));
}

Patch patch_of(const Shape& shape, std::int32_t k, const Vec3& outward) {
    Patch patch;
    patch.share = shape.area[k];
    patch.facing = shape.normal[k].dot(outward);
    patch.spread_cos = shape.spread_cos[k];
    patch.spread_sin = shape.spread_sin[k];
    patch.wing = wing_length(shape.radius[k], patch.share, patch.spread_cos, patch.spread_sin);
    // depth counts from an edge's corner, but on a face that leans from the sphere's foremost point
    const double facing = std::clamp(patch.facing, -1.0, 1.0);
    if (shape.faces[k].count == 0 && facing < patch.spread_cos) {
        const double lean = facing * patch.spread_cos +
                            std::sqrt(1.0 - facing * facing) * patch.spread_sin;  // cos(t - s)
        patch.foot = shape.radius[k] * (1.0 - lean);
    }
    return patch;
}

// The probe's patch. Where the hull is the probe, the ice it digs into is still what crushes.
Patch probe_patch(const PairView& view, const Candidate& c) {
    const Vec3 out_a = c.gap.normal, out_b = view.turn.transpose() * -c.gap.normal;
    const bool ship = view.pair.a == static_cast<std::int32_t>(kShip);
    Patch patch = c.gap.a_is_surface ? patch_of(view.shape_b, c.j, out_b)
                                     : patch_of(view.shape_a, c.i, out_a);
    patch.depth = -c.gap.gap + (c.gap.a_is_surface || ship
                                    ? crushed_depth(view.scene, view.pair.b, c.j, out_b)
                                    : crushed_depth(view.scene, view.pair.a, c.i, out_a));
    return patch;
}

// Surface of an ice sphere as seen along the contact normal: with the mean normal m and the
// half-angle s of the faces that meet there, cos(s) m is the sphere's vector area per area.
double facing_area(const Shape& shape, std::int32_t k, const Vec3& outward) {
    const double facing = shape.spread_cos[k] * shape.normal[k].dot(outward);
    return shape.area[k] * std::max(facing, kLeastFacing);
}

// Contacts per sphere of one side; of spheres not in contact the entry is not set.
void count_contacts(const std::vector<Candidate>& all, std::int32_t Candidate::*side,
                    std::size_t spheres, std::vector<std::int32_t>& out) {
    if (out.size() < spheres) out.resize(spheres);
    for (const Candidate& c : all) out[static_cast<std::size_t>(c.*side)] = 0;
    for (const Candidate& c : all) ++out[static_cast<std::size_t>(c.*side)];
}

// Midway between two edges where they cross.
Vec3 crossing_point(const SphereSurface& a, const SphereSurface& b, const Gap& gap) {
    const Vec3 pa = support_point(a, gap.normal), pb = support_point(b, -gap.normal);
    const Vec3 ea = a.faces.edge(gap.edge_a), eb = b.faces.edge(gap.edge_b);
    const Crossing at = find_crossing(pa, ea, pb, eb);
    return 0.5 * (pa + at.along_a * ea + pb + at.along_b * eb);
}

// The probe decides where the bodies meet: midway between its surface and the other one's.
Vec3 meeting_point(const PairView& view, NormalRule rule, const Candidate& c) {
    if (c.gap.crossing) return crossing_point(view.sphere_a(c.i), view.sphere_b(c.j), c.gap);
    const double sign = c.gap.a_is_surface ? -1.0 : 1.0;
    const Vec3 outward = sign * c.gap.normal;
    const bool of_b = c.gap.a_is_surface;
    const Vec3 surface =
        rule == NormalRule::centres
            ? (of_b ? Vec3(view.center_b(c.j) + view.shape_b.radius[c.j] * outward)
                    : Vec3(view.center_a(c.i) + view.shape_a.radius[c.i] * outward))
            : (of_b ? view.support_b(c.j, outward) : view.support_a(c.i, outward));
    return surface + 0.5 * c.gap.gap * outward;
}

void emit_all(const PairView& view, NormalRule rule, const std::vector<Candidate>& candidates,
              std::vector<Contact>& out) {
    const Bodies& bodies = view.scene.bodies;
    const Mat3& rotation = bodies.rotation[view.pair.a];
    const bool ship = view.pair.a == static_cast<std::int32_t>(kShip);
    std::int32_t last_probe = -1, face = 0;
    for (const Candidate& c : candidates) {
        Contact contact;
        contact.a = view.pair.a;
        contact.b = view.pair.b;
        contact.sphere_a = c.i;
        contact.sphere_b = c.j;
        contact.gap = c.gap.gap;
        contact.normal = rotation * c.gap.normal;
        const Vec3 local = meeting_point(view, rule, c);
        contact.point = rotation * local + bodies.position[view.pair.a];
        contact.crushes_a = !ship && !c.gap.a_is_surface;
        contact.patch = probe_patch(view, c);
        contact.region = ship ? view.shape_a.region.at(c.i, c.gap.normal) : -1;
        // a probe slides over many surface spheres: the probe and its face's rank are what lasts
        const std::int32_t probe = (c.probe() << 1) | (c.gap.a_is_surface ? 1 : 0);
        face = probe == last_probe ? face + 1 : 0;
        last_probe = probe;
        contact.key = (static_cast<std::uint64_t>(probe) << 32) | static_cast<std::uint32_t>(face);
        out.push_back(contact);
    }
}

// Sphere on sphere: every pair of spheres is a contact, and shares of the surface are split.
void finish_centres(const PairView& view, const std::vector<Candidate>& candidates,
                    std::vector<Contact>& out) {
    const bool ship = view.pair.a == static_cast<std::int32_t>(kShip);
    thread_local std::vector<std::int32_t> shared_a, shared_b;  // keep their memory
    count_contacts(candidates, &Candidate::j, view.shape_b.center.size(), shared_b);
    // the hull has many spheres and its shares are not asked for
    if (!ship) count_contacts(candidates, &Candidate::i, view.shape_a.center.size(), shared_a);
    const auto first = out.end() - static_cast<std::ptrdiff_t>(candidates.size());
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        const Candidate& c = candidates[k];
        Contact& contact = first[static_cast<std::ptrdiff_t>(k)];
        contact.key = (static_cast<std::uint64_t>(c.i) << 32) | static_cast<std::uint32_t>(c.j);
        double area = facing_area(view.shape_b, c.j, view.turn.transpose() * -c.gap.normal) /
                      shared_b[static_cast<std::size_t>(c.j)];
        if (!ship)
            area = std::min(area, facing_area(view.shape_a, c.i, c.gap.normal) /
                                      shared_a[static_cast<std::size_t>(c.i)]);
        contact.patch = Patch{.share = area};
    }
}

}  // namespace

void emit_contacts(const PairView& view, NormalRule rule, const std::vector<Candidate>& candidates,
                   std::vector<Contact>& out) {
    if (candidates.empty()) return;
    emit_all(view, rule, candidates, out);
    if (rule == NormalRule::centres) finish_centres(view, candidates, out);
}

}  // namespace ice
