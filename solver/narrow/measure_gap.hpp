// SPDX-License-Identifier: GPL-3.0-or-later
/// Distance and normal of two contact spheres, by the paper's rule and by ours.
#pragma once

#include <cstdint>
#include <limits>

#include "solver/shape/shape.hpp"

namespace ice {

/// A contact sphere and the surface it stands for, in some common axes.
struct SphereSurface {
    Vec3 center;        ///< [m]
    double radius;      ///< [m]
    Vec3 normal;        ///< outward unit normal, the middle one where several meet
    double spread_cos;  ///< cosine and sine of the half-angle of the normals that meet there;
    double spread_sin;  ///<   1 and 0 on a face
    Faces faces = {};   ///< that meet there, where they are known
    /// How far around it stands for its surface [m].
    double reach = std::numeric_limits<double>::infinity();
};

/// What lies between sphere a and sphere b.
struct Gap {
    Vec3 normal;        ///< unit, from a to b
    double gap;         ///< along the normal, negative where the surfaces overlap [m]
    double lateral_sq;  ///< squared distance across the normal from the probe's foremost point to
                        ///< the part of the surface that the other sphere stands for [m2]
    bool a_is_surface;  ///< b is the probe on a's surface; otherwise a is the probe on b's
    bool valid;         ///< false where the spheres do not face each other
    bool crossing = false;  ///< two edges meet across each other, neither on the other's face
    std::int8_t edge_a = -1, edge_b = -1;  ///< which of the spheres' Faces::edge these are
    /// Where they cross, lateral_sq is measured along the surface's edge and this along the
    /// probe's, each from its sphere's corner: a sphere stands for its edge half way to the next.
    double probe_sq = 0.0;
};

/// Where two edges, through pa along unit ea and through pb along unit eb, are nearest: how far
/// from there [m]. Parallel edges give infinities.
struct Crossing {
    double along_a, along_b;
};
Crossing find_crossing(const Vec3& pa, const Vec3& ea, const Vec3& pb, const Vec3& eb);

/// Foremost point of the surface along the outward unit vector n.
///
/// Where faces are known to meet, their planes, all tangent to the sphere, meet at the point
/// r / cos s along the middle normal, Faces::corner: a floe keeps its sharp edges; rounded by the
/// spheres' radius it would slide past corners that it should catch. Elsewhere it is the sphere's
/// own.
Vec3 support_point(const SphereSurface& s, const Vec3& n);

/// The same less the centre [m], of a sphere with these faces, radius [m] and middle normal.
inline Vec3 support_offset(const Faces& faces, double radius, const Vec3& middle, const Vec3& n) {
    return faces.count == 0 ? Vec3(radius * n) : Vec3(faces.corner * middle);
}

/// The paper's rule (Figure 1): normal from centre to centre, gap |d| - (r_a + r_b).
///
/// Coincident centres have no direction and give an invalid gap.
inline Gap measure_gap_centres(const Vec3& center_a, double radius_a, const Vec3& center_b,
                               double radius_b) {
    const Vec3 d = center_b - center_a;
    const double length = d.norm();
    if (length == 0.0) return {Vec3::UnitZ(), 0.0, 0.0, true, false};
    return {d / length, length - (radius_a + radius_b), 0.0, true, true};
}

/// Our rule: a sphere touches its surface from inside, so the surface near it is the sphere's cap
/// over the normals that meet there: a plane on a face, an arc on an edge.
///
/// A face gives its own normal; of two faces b's probe takes a's where `prefer_a`, else the mean.
/// Of two edges or corners that know their faces, each face's normal and those across two edges are
/// tried and the one with the largest gap taken: the separating direction of the two local solids.
/// Where another face is less deep in all that the spheres stand for, they meet elsewhere: invalid.
///
/// Where that gap is a face's, the two edges that cross nearest, in reach of both spheres, may
/// decide instead, across them: where neither corner is over what the other sphere stands for of
/// the face, and where they are deeper along a normal of the same face. So an edge on a face's
/// border, or one that crosses another at a small angle, is felt where it is, between two spheres.
///
/// Where one of the two does not know its faces the flatter side gives the one of its normals that
/// is nearest to the line of centres. The flatter side (the smaller spread; of two edges the one
/// that has the other's corner above it, a if both) is the surface, the other one the probe. With n
/// chosen,
///
///     gap = n . (support_point(b, -n) - support_point(a, n)),
///
/// exact for a face on a face, an edge on a face and an edge across an edge: a flat hull is flat
/// and a floe's edge sharp, whatever spheres stand for them. Invalid where n is not a normal of
/// both sides (to about 3 degrees at edges), the centres are not on the proper sides, n . (c_b -
/// c_a) <= 0, or neither edge's corner is over the other's face and no edges cross in reach.
Gap measure_gap_surface(const SphereSurface& a, const SphereSurface& b, bool prefer_a);

}  // namespace ice
