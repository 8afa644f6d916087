// SPDX-License-Identifier: GPL-3.0-or-later
/// Gap and normal of two contact spheres, under the rules "centres" and "surface".
#pragma once

#include <cstdint>
#include <limits>

#include "solver/shape/shape.hpp"

namespace ice {

/// A contact sphere and the local feature of the surface that it represents, in common axes.
struct Feature {
    Vec3 center;           ///< [m]
    double radius;         ///< [m]
    Vec3 normal;           ///< outward unit normal, the middle one on an edge or vertex
    double spread_cos;     ///< cosine and sine of the half-angle s of the normal cone [-];
    double spread_sin;     ///<   1 and 0 on a face
    NormalCone cone = {};  ///< of the faces that meet there, where they are known
    /// Radius of the surface that it represents [m].
    double patch_radius = std::numeric_limits<double>::infinity();
};

/// Gap between sphere a and sphere b.
struct Gap {
    Vec3 normal;  ///< unit, from a to b
    double gap;   ///< along the normal, negative where the surfaces overlap [m]
    /// Squared distance across the normal from the incident support point to the patch that the
    /// reference sphere represents [m2].
    double reference_offset_sq;
    bool reference_is_a;    ///< a's feature is the reference and b's incident; else vice versa
    bool valid;             ///< false where the spheres do not face each other
    bool crossing = false;  ///< two edges meet across each other, neither on the other's face
    std::int8_t edge_a = -1, edge_b = -1;  ///< which of the spheres' NormalCone::edge these are
    /// Where two edges meet, reference_offset_sq is measured along the reference edge and this
    /// along the incident one [m2], each from its sphere's apex: a sphere represents its edge half
    /// way to the next.
    double incident_offset_sq = 0.0;
};

/// Closest points of two lines, through pa [m] along unit ea and through pb [m] along unit eb:
/// their places along the lines [m]. Parallel lines give NaN, nearly parallel ones large numbers.
struct LineParameters {
    double along_a, along_b;
};
LineParameters closest_on_lines(const Vec3& pa, const Vec3& ea, const Vec3& pb, const Vec3& eb);

/// Foremost point of the feature along the outward unit vector n [m] (docs/method.md, section 3).
///
/// The faces' planes, all tangent to the sphere, meet at the apex, r / cos s along the middle
/// normal (NormalCone::apex_distance). So a floe keeps its sharp edges: rounded by the spheres'
/// radius it would slide past corners on which it should catch. A sphere without known faces has
/// its own foremost point.
Vec3 support_point(const Feature& s, const Vec3& n);

/// The support point less the centre [m], of a sphere with these faces, radius [m] and middle
/// normal.
inline Vec3 support_offset(const NormalCone& faces, double radius, const Vec3& middle,
                           const Vec3& n) {
    return faces.count == 0 ? Vec3(radius * n) : Vec3(faces.apex_distance * middle);
}

/// The paper's rule (Figure 1): normal from centre to centre, gap |d| - (r_a + r_b).
///
/// Coincident centres have no direction and give an invalid gap. Centres and radii in [m].
inline Gap measure_gap_centres(const Vec3& center_a, double radius_a, const Vec3& center_b,
                               double radius_b) {
    const Vec3 d = center_b - center_a;
    const double length = d.norm();
    if (length == 0.0) return {Vec3::UnitZ(), 0.0, 0.0, true, false};
    return {d / length, length - (radius_a + radius_b), 0.0, true, true};
}

/// The rule "surface", equation (3): the axis with the largest gap separates the two features.
///
///     gap = n . (support_point(b, -n) - support_point(a, n))
///
/// Choice of the axis n:
/// - A face gives its own normal. Of two faces, a's where `prefer_reference_a`, else the mean.
/// - Of two edges or vertices with known faces: of all face axes and edge axes the one with the
///   largest gap.
/// - Where that is a face axis, the two edges that cross nearest within both patch radii replace it
///   if neither apex lies over the other's part of the face, or if they are deeper along nearly the
///   same normal. So an edge at the end of a face, or one that crosses another at a small angle,
///   meets the other body at the crossing, between two spheres.
/// - If the faces of one of the two are unknown, the flatter side gives its normal that is nearest
///   to the line of centres.
///
/// The flatter side is the reference: the smaller spread; of two edges the one below the other's
/// apex, a if both. The gap is exact for a face on a face, an edge on a face and an edge across an
/// edge, whatever the radius of the spheres.
///
/// Invalid where n is not in both cones (to 0.3 degrees where faces are square, and to 1.3 degrees
/// along an edge), where n . (c_b - c_a) <= 0, as with coincident centres,
/// where neither apex lies over the other's face and no edges cross within the patch radii, and
/// where another face is penetrated less over the whole patch: the bodies then meet elsewhere.
/// `normal` and `gap` of an invalid one mean nothing.
Gap measure_gap_surface(const Feature& a, const Feature& b, bool prefer_reference_a);

}  // namespace ice
