// SPDX-License-Identifier: GPL-3.0-or-later
/// Tolerances and small parts of the rule of measure_gap_surface, shared with FeaturePair and
/// FeaturePairBound, which must give the same bits.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/narrow/feature/measure_gap.hpp"

namespace ice {

/// Spreads closer than this (cosine) [-] count as equally flat: normals are stored as floats. With
/// less, rounding decides which of two equal features is the reference; with more, a slightly
/// rounded part and a face count as two faces.
constexpr double kSameSpread = 1e-6;

/// Cosine of the angle between a face's normal and the contact's [-], 78 degrees: below it the face
/// leans so much that its edge is met first. Larger: faces lose contacts that their edges must then
/// give; smaller: faces nearly upright to the contact have contacts beside those of their edges.
constexpr double kLeaning = 0.2;

/// Largest component of a normal along an edge (cosine) [-]: an edge that slants towards a face
/// meets it at its end, two edges meet where they cross. kSlantOnFace lets all normals through but
/// those within 18 degrees of the edge, kSlantOnEdge only those within 1.3 degrees of square to it.
/// kSlantOnEdge is more than kParallel, so two edges always have a face axis or an edge axis. A
/// larger one takes a face's normal where the crossing of two edges is nearer.
constexpr double kSlantOnFace = 0.95, kSlantOnEdge = 0.022;

/// Edges closer to parallel than this (sine, 1.1 degrees) [-] have no edge axis. With a half, the
/// overlaps of bench scenes halved and the narrow phase took 20 to 40 % more time.
constexpr double kParallel = 0.02;
static_assert(kSlantOnEdge > kParallel);

/// An incident sphere takes normals closer than 30 degrees (cosine) [-] as those of one face.
/// Larger gives two contacts where a sphere meets a gently curved face; smaller merges two faces of
/// an obtuse edge into one.
constexpr double kSameFace = 0.866;

/// A vertex lies over a face up to this many radii [-] beyond the face's edge: 1 mm with spheres of
/// 0.1 m, more than rounding. Larger: contacts beyond a face's end; smaller: vertices on flush
/// edges lose their contact from step to step.
constexpr double kBeyond = 0.01;

/// The sphere of an edge or vertex represents its body within this many radii [-]: beyond them the
/// next spheres do. Larger: fewer contacts are dropped because the bodies meet elsewhere.
constexpr double kAround = 2.0;

/// Distances and squared distances, in radii and their squares [-], that count as equal: flush
/// edges differ by rounding only, and shall have the same axis in each step. Larger keeps the
/// face's axis where the crossing is really deeper; 0 lets rounding choose.
constexpr double kFlush = 1e-3;

/// v without its part along the unit vector n; the unit is that of v.
inline Vec3 part_across(const Vec3& v, const Vec3& n) { return v - v.dot(n) * n; }

/// The part of a face that the sphere of an edge or vertex represents: a segment from below its
/// centre to the apex.
struct Footprint {
    Vec3 out;       ///< from the centre to the apex, across the face's normal [m]
    double length;  ///< its length [m]; 0 where the apex lies over the centre
};
/// On the face with the unit normal n.
inline Footprint footprint(const Feature& s, const Vec3& n) {
    const Vec3 out = part_across(s.cone.apex_distance * s.normal, n);
    return {out, out.norm()};
}

/// Squared distance [m2] of a point from the footprint of a sphere of this radius; `at` is the
/// point's place from the centre across the normal [m]. The face ends at the apex: infinite more
/// than `slack` [m] beyond it.
inline double distance_from(const Footprint& foot, double radius, const Vec3& at, double slack) {
    if (foot.length <= kBeyond * radius) return at.squaredNorm();
    const double along = at.dot(foot.out) / foot.length;
    if (along > foot.length + kBeyond * radius + slack)
        return std::numeric_limits<double>::infinity();
    const double excess = along - std::clamp(along, 0.0, foot.length);
    return std::max(at.squaredNorm() - along * along, 0.0) + excess * excess;
}

/// Is n an outward normal of the feature? Not of a face that is nearly upright to n: its edges are
/// met first. @param slack  widens all bounds [rad]
inline bool belongs(const Feature& s, const Vec3& n, double slack = 0.0) {
    if (s.cone.count > 0) return s.cone.contains(n, kSlantOnFace, slack);
    return s.normal.dot(n) >= std::min(kLeaning, s.spread_cos) - slack;
}

/// From the centre to the support point along the outward unit vector n [m].
inline Vec3 support_offset(const Feature& s, const Vec3& n) {
    return support_offset(s.cone, s.radius, s.normal, n);
}

/// Squared distance of the crossing from the two spheres, along the edges [m2].
inline double distance_sq(const LineParameters& at) {
    return at.along_a * at.along_a + at.along_b * at.along_b;
}
/// Do the edges cross within the patch radius of both spheres?
inline bool is_within_patches(const LineParameters& at, const Feature& a, const Feature& b) {
    return std::abs(at.along_a) <= a.patch_radius && std::abs(at.along_b) <= b.patch_radius;
}

/// The gap across two edges. @param n  unit axis from a to b @param gap  along it [m]
/// @param at  places of the crossing from both apexes [m] @param edge_a, edge_b  NormalCone::edge
inline Gap crossing_gap(const Vec3& n, double gap, const LineParameters& at, bool reference_is_a,
                        std::int8_t edge_a, std::int8_t edge_b) {
    const double a_sq = at.along_a * at.along_a, b_sq = at.along_b * at.along_b;
    return {.normal = n,
            .gap = gap,
            .reference_offset_sq = reference_is_a ? a_sq : b_sq,
            .reference_is_a = reference_is_a,
            .valid = true,
            .crossing = true,
            .edge_a = edge_a,
            .edge_b = edge_b,
            .incident_offset_sq = reference_is_a ? b_sq : a_sq};
}

/// True if, over everything that the other sphere represents, some face of s is penetrated less
/// than `gap`: the bodies then touch at a neighbouring sphere, not here. A vertex may lie deep
/// behind one face's plane and yet outside another's, which its body enters far from here. False
/// for a feature without known faces.
/// @param apart  from s's apex to the other one's [m]
/// @param gap    along the axis found, below 0 [m]
bool is_less_deep(const Feature& s, const Feature& other, const Vec3& apart, double gap);

}  // namespace ice
