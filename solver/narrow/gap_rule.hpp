// SPDX-License-Identifier: GPL-3.0-or-later
/// Pieces of the rule of measure_gap_surface, for those who must agree on them.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/narrow/measure_gap.hpp"

namespace ice {

/// Spreads closer than this (in cosine) count as equally flat: normals are stored as floats.
constexpr double kSameSpread = 1e-6;

/// Cosine of the tilt of a face that is met edge first.
constexpr double kLeaning = 0.2;

/// A face cuts into an edge that slants towards it all along; two edges meet where they cross.
/// kSlantOnEdge is more than kParallel: an edge always has a face's normal or one across both.
constexpr double kSlantOnFace = 0.95, kSlantOnEdge = 0.022;

/// Edges closer to parallel than this (sine) have no normal across both.
constexpr double kParallel = 0.02;
static_assert(kSlantOnEdge > kParallel);

/// Normals closer than 30 degrees are of the same face, for a probe.
constexpr double kSameFace = 0.866;

/// A corner is over a face as long as it is not this many radii beyond the face's edge.
constexpr double kBeyond = 0.01;

/// An edge's or corner's sphere stands for its body as far as this many radii around.
constexpr double kAround = 2.0;

/// Distances and squared distances (in radii) that count as equal: flush edges differ by rounding
/// only, and shall be met in the same way step after step.
constexpr double kFlush = 1e-3;

/// v without its part along the unit vector n.
inline Vec3 part_across(const Vec3& v, const Vec3& n) { return v - v.dot(n) * n; }

/// What an edge's or corner's sphere stands for of a face: from above its centre out to the corner.
struct Foothold {
    Vec3 out;      ///< that way, across the face's normal [m]
    double reach;  ///< its length [m]
};
inline Foothold foothold(const SphereSurface& s, const Vec3& n) {
    const Vec3 out = part_across(s.faces.corner * s.normal, n);
    return {out, out.norm()};
}

/// Squared distance [m2] of a point, `at` from the centre across the normal [m], from a foothold of
/// a sphere of this radius. There is nothing beyond the corner, where the other body's edge has
/// nothing under it: infinite there, by more than `slack` [m].
inline double distance_from(const Foothold& foot, double radius, const Vec3& at, double slack) {
    if (foot.reach <= kBeyond * radius) return at.squaredNorm();
    const double along = at.dot(foot.out) / foot.reach;
    if (along > foot.reach + kBeyond * radius + slack)
        return std::numeric_limits<double>::infinity();
    const double excess = along - std::clamp(along, 0.0, foot.reach);
    return std::max(at.squaredNorm() - along * along, 0.0) + excess * excess;
}

/// Is n an outward normal of the surface there? No face that stands all but upright: its edges are
/// before it. @param slack  bounds are wider by this [rad]
inline bool belongs(const SphereSurface& s, const Vec3& n, double slack = 0.0) {
    if (s.faces.count > 0) return s.faces.have(n, kSlantOnFace, slack);
    return s.normal.dot(n) >= std::min(kLeaning, s.spread_cos) - slack;
}

inline Vec3 support_offset(const SphereSurface& s, const Vec3& n) {
    return support_offset(s.faces, s.radius, s.normal, n);
}

/// How far from their spheres two edges cross, squared [m2].
inline double distance_sq(const Crossing& at) {
    return at.along_a * at.along_a + at.along_b * at.along_b;
}
/// Do they cross on what the spheres stand for?
inline bool is_in_reach(const Crossing& at, const SphereSurface& a, const SphereSurface& b) {
    return std::abs(at.along_a) <= a.reach && std::abs(at.along_b) <= b.reach;
}

/// The gap across two edges.
inline Gap crossing_gap(const Vec3& n, double gap, const Crossing& at, bool a_is_surface,
                        std::int8_t edge_a, std::int8_t edge_b) {
    const double a_sq = at.along_a * at.along_a, b_sq = at.along_b * at.along_b;
    return {.normal = n,
            .gap = gap,
            .lateral_sq = a_is_surface ? a_sq : b_sq,
            .a_is_surface = a_is_surface,
            .valid = true,
            .crossing = true,
            .edge_a = edge_a,
            .edge_b = edge_b,
            .probe_sq = a_is_surface ? b_sq : a_sq};
}

/// Is one of s's faces less deep in all that the other sphere stands for than `gap`? Then that is
/// where the bodies meet, somewhere beside. A corner may lie deep behind one face's plane and yet
/// outside another's, which its body, turned a little, enters far from here.
/// @param apart  from s's corner to the other one's [m]
bool is_less_deep(const SphereSurface& s, const SphereSurface& other, const Vec3& apart,
                  double gap);

}  // namespace ice
