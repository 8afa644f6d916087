// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/manifold/find_polygon.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/base/assert.hpp"
#include "common/math/ordered_products.hpp"
#include "solver/narrow/feature/deep_pair.hpp"
#include "solver/narrow/feature/face_corners.hpp"
#include "solver/narrow/feature/nearest_sphere.hpp"
#include "solver/narrow/manifold/make_contacts.hpp"

namespace ice {

namespace {

// b's surface counts up to this far outside a [m]: faces that touch press with their whole
// section. A larger value makes sections of edges and corners too large by as much of their depth.
constexpr double kReach = 1e-3;

// How far behind the surfaces that meet the solids are sliced, to tell which is more slender [-],
// in radii of the smaller one. A larger depth may pass right through thin ice, a smaller one
// compares areas of the size of rounding.
constexpr double kSliceDepth = 0.04;

// Corners this near to each other along the face are one [m]: a side plane's slack (kBesidePlane)
// makes two of the corner of a flush face. Larger joins corners of small faces; smaller weights one
// place twice.
constexpr double kSamePlace = 2.0 * PolygonTolerances::kBesidePlane;

// A corner with less area (twice, m2) lies on the line of its neighbours: that is rounding. A
// larger value drops corners that carry load.
constexpr double kNoArea = 1e-6;

// Slices this near to each other [-] are equal: rounding of areas shall not decide.
constexpr double kSameArea = 1e-6;

// Distance of the farthest corner from the centre of mass [m].
double radius_of(const ConvexPiece& piece) {
    double most = 0.0;
    for (std::size_t k = 0; k < piece.corners.size(); ++k)
        most = std::max(most, piece.corners[k].norm());
    return most;
}

// The section of two solids on each corner of their polygon [m2]. Corners that are open by more
// than the reach carry nothing yet, and take no share from the others.
double section_of_corner(const SolidPair& solids, const ContactPolygon& polygon, double gap,
                         SectionWork& work) {
    const double reach = std::max(gap, 0.0) + kReach;
    const auto pressed =
        std::count_if(polygon.corners.begin(), polygon.corners.end(),
                      [&](const PolygonCorner& corner) { return corner.gap <= reach; });
    return section_area(solids.a, solids.b, solids.pose, polygon.normal, reach, work) /
           static_cast<double>(pressed);
}

// A length in whole steps of kSameGap: lengths that differ by rounding are equal.
std::int64_t steps(double length) {
    return static_cast<std::int64_t>(length / kSameGap + std::copysign(0.5, length));
}

// Orders corners by place, as place_key() does; coordinates that differ by rounding are equal.
bool comes_before(const PolygonCorner& l, const PolygonCorner& r) {
    for (const auto& [p, q] : {std::pair(l.point.x(), r.point.x()),
                               std::pair(std::abs(l.point.y()), std::abs(r.point.y())),
                               std::pair(l.point.z(), r.point.z())}) {
        const std::int64_t at_p = steps(p), at_q = steps(q);
        if (at_p != at_q) return at_p < at_q;
    }
    return place_key(l) < place_key(r);
}

// Orders corners by depth. Of equally deep ones corners of a body come before edges that cross side
// planes.
// @param gap_of  of a corner [m]
template <class Gap>
bool is_deeper_by(const Gap& gap_of, const PolygonCorner& l, const PolygonCorner& r) {
    const auto gap = [&](const PolygonCorner& c) {
        return steps(gap_of(c)) + static_cast<std::int64_t>(kind_of_corner(c));
    };
    const std::int64_t of_l = gap(l), of_r = gap(r);
    return of_l < of_r || (of_l == of_r && comes_before(l, r));
}

bool is_deeper(const PolygonCorner& l, const PolygonCorner& r) {
    return is_deeper_by([](const PolygonCorner& c) { return c.gap; }, l, r);
}

// Drops corners that stay open in the step, if nothing hinders the bodies, until no more than a
// contact's corners are left. One that closes may be the only one on its side.
void drop_open(const RelativeStep& step, ContactPolygon& polygon) {
    auto& corners = polygon.corners;
    const auto least_gap = [&](const PolygonCorner& c) {
        return c.gap + std::min(ordered_dot(polygon.normal, step.at(c.point)), 0.0);
    };
    std::sort(corners.begin(), corners.end(), [&](const PolygonCorner& l, const PolygonCorner& r) {
        return is_deeper_by(least_gap, l, r);
    });
    const double open = std::max(least_gap(corners.front()), 0.0) + kReach;
    while (corners.size() > kManifoldCorners && least_gap(corners.back()) > open)
        corners.pop_back();
}

// Area of the triangle that the polygon loses with corner k, seen along the normal [m2], twice; not
// positive where the corner lies within the others.
double loss_of(const ContactPolygon& polygon, std::size_t k) {
    const auto& corners = polygon.corners;
    const std::size_t n = corners.size();
    const Vec3 &at = corners[k].point, before = corners[(k + n - 1) % n].point - at,
               after = corners[(k + 1) % n].point - at;
    return ordered_dot(polygon.normal, Vec3(after.cross(before)));
}

// Drops corners within the others, but for the deepest. @pre order_around
void drop_inner(ContactPolygon& polygon) {
    auto& corners = polygon.corners;
    const PolygonCorner deepest = *std::min_element(corners.begin(), corners.end(), is_deeper);
    for (std::size_t k = 0; k < corners.size() && corners.size() > kManifoldCorners;) {
        if (corners[k].id == deepest.id || loss_of(polygon, k) > kNoArea) {
            ++k;
            continue;
        }
        corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(k));
        k = k > 0 ? k - 1 : 0;  // the one before has another neighbour now
    }
}

// Of two corners at one place along the face the deeper one stays.
void drop_doubles(ContactPolygon& polygon) {
    auto& corners = polygon.corners;
    std::size_t kept = 0;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const PolygonCorner corner = corners[k];
        std::size_t same = 0;
        for (; same < kept; ++same) {
            const Vec3 apart = corner.point - corners[same].point;
            const double height = ordered_dot(polygon.normal, apart);
            if (ordered_dot(apart, apart) - height * height < kSamePlace * kSamePlace) break;
        }
        if (same == kept)
            corners[kept++] = corner;
        else if (is_deeper(corner, corners[same]))
            corners[same] = corner;
    }
    corners.resize(kept);
}

// Chooses the corners that carry the load. Of two at one place the deeper one stays. Open ones are
// dropped first. The corners that are left span the largest area.
void choose_corners(const PairStep& step, ContactPolygon& polygon) {
    drop_doubles(polygon);
    if (polygon.corners.size() <= kManifoldCorners) return;
    drop_open(step.relative(), polygon);
    if (polygon.corners.size() <= kManifoldCorners) return;
    order_around(polygon);
    drop_inner(polygon);
    reduce_polygon(kManifoldCorners, polygon);
}

}  // namespace

PairRule pair_rule_of(const Scene& scene, BodyPair pair, const ContactRule& rule) {
    // How deep the ship has crushed ice is known at the ice's spheres alone.
    if (rule.normal != NormalRule::surface ||
        (rule.crushes && pair.a == static_cast<std::int32_t>(kShip)))
        return PairRule::spheres;
    const Shape &a = scene.shape_of(pair.a), &b = scene.shape_of(pair.b);
    // Only the ship crushes level ice, but contacts of solids would cut the body without parts.
    // Such a pair therefore meets by its spheres.
    if (rule.crushes && (!a.parts.empty() || !b.parts.empty()))
        return a.parts.empty() || b.parts.empty() ? PairRule::spheres : PairRule::parts;
    return a.convex.empty() || b.convex.empty() ? PairRule::spheres : PairRule::solids;
}

void find_polygon(const SolidPair& solids, const SeparatingAxes& axes, double most,
                  const PairStep& step, ClippingWork& work, ContactPolygon& polygon) {
    make_contact_polygon(solids.a, solids.b, solids.pose, axes, IncidentFaces::all, most, work,
                         polygon);
    choose_corners(step, polygon);
    std::sort(polygon.corners.begin(), polygon.corners.end(), comes_before);
}

void append_pressed(const SolidPair& solids, const ContactPolygon& polygon, SectionWork& work,
                    std::vector<MetCorner>& out) {
    if (polygon.corners.empty()) return;
    const auto& [a, b, pose] = solids;
    const Vec3& n = polygon.normal;
    const PolygonCorner& deepest =
        *std::min_element(polygon.corners.begin(), polygon.corners.end(),
                          [](const auto& l, const auto& r) { return l.gap < r.gap; });
    const double section = section_of_corner(solids, polygon, deepest.gap, work);
    const double at = n.dot(deepest.point),
                 behind = kSliceDepth * std::min(radius_of(a), radius_of(b)) +
                          0.5 * std::abs(deepest.gap);
    const double of_a = slice_area(a, n, at - behind),
                 of_b = slice_area(b, pose.rotation.transpose() * n,
                                   at + behind - n.dot(pose.translation));
    const bool crushes_a = of_a < (1.0 - kSameArea) * of_b;
    for (const PolygonCorner& corner : polygon.corners)
        out.push_back({corner, n, section, crushes_a});
}

void make_polygon_contacts(const PairView& view, const ContactRule& rule,
                           std::span<const MetCorner> corners, Contact* out) {
    const Mat3& rotation = view.scene.bodies.rotation[view.pair.a];
    const bool ship = view.pair.a == static_cast<std::int32_t>(kShip);
    const bool solids = pair_rule_of(view.scene, view.pair, rule) != PairRule::spheres;
    for (const auto& [corner, normal, section, crushes_a] : corners) {
        Contact& contact = *out++;
        contact.a = view.pair.a;
        contact.b = view.pair.b;
        contact.sphere_a = ship ? nearest_sphere(view.shape_a, corner.point) : -1;
        contact.sphere_b = -1;
        // The warm start finds a corner again by the two features that meet in it.
        // No sphere has the first bit, and a deep seat has the second one, too.
        contact.key = std::uint64_t{1} << 63 | corner.id;
        contact.point = rotation * corner.point + view.scene.bodies.position[view.pair.a];
        contact.normal = rotation * normal;
        contact.gap = corner.gap;
        contact.patch = Patch{};
        contact.patch.depth = -corner.gap;
        contact.region = ship ? view.shape_a.region.at(contact.sphere_a, normal) : -1;
        contact.crushes_a = crushes_a;
        contact.section = section;
        if (solids) continue;
        // Crushing needs spheres: those nearest to the corner lend share and patch.
        if (!ship) contact.sphere_a = nearest_sphere(view.shape_a, corner.point);
        contact.sphere_b = nearest_sphere(view.shape_b, view.to_b(corner.point));
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
    const SolidPair solids{
        view.shape_a.convex, view.shape_b.convex, {view.rotation_ab, view.translation_ab}};
    const SeparatingAxes axes = find_axes(solids.a, solids.b, solids.pose, 0.0);
    double least = 0.0;
    // A polygon is needed only if no sphere's contact is as deep as the solids, less what was
    // crushed and the slack.
    for (const Candidate& c : found) least = std::min(least, c.gap.gap);
    const double crushed =
        view.scene.crushed.deepest_of(view.pair.a) + view.scene.crushed.deepest_of(view.pair.b);
    if (axes.widest() + crushed + lost_slack(view) < least)
        // without motion: corners that close within the step have contacts of spheres
        find_polygon(solids, axes, most, {}, work, polygon);
}

}  // namespace ice
