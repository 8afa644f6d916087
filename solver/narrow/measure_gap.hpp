// SPDX-License-Identifier: GPL-3.0-or-later
/// Distance and normal of two contact spheres, by the paper's rule and by ours.
#pragma once

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// A contact sphere and the surface it stands for, in some common axes.
struct SphereSurface {
    Vec3 center;        ///< [m]
    double radius;      ///< [m]
    Vec3 normal;        ///< outward unit normal, the middle one where several meet
    double spread_cos;  ///< cosine and sine of the half-angle of the normals that meet there;
    double spread_sin;  ///<   1 and 0 on a face
};

/// What lies between sphere a and sphere b.
struct Gap {
    Vec3 normal;        ///< unit, from a to b
    double gap;         ///< along the normal, negative where the surfaces overlap [m]
    double lateral_sq;  ///< squared distance of the centres across the normal [m2]
    bool a_is_surface;  ///< b is the probe on a's surface; otherwise a is the probe on b's
    bool valid;         ///< false where the spheres do not face each other
};

/// The paper's rule (Figure 1): normal from centre to centre, gap |d| - (r_a + r_b).
///
/// Coincident centres have no direction and give an invalid gap.
Gap measure_gap_centres(const SphereSurface& a, const SphereSurface& b);

/// Our rule: a sphere touches its surface from inside, so the surface near it is the sphere's cap
/// over the normals that meet there: a plane on a face, an arc on an edge.
///
/// Each side proposes the direction of its cap nearest to the line of centres; the flatter side
/// (the smaller spread) is the surface, the other one the probe. On equal spread `prefer_a`
/// decides for a, else the mean of both proposals is taken. With n chosen,
///
///     gap = n . (c_b - c_a) - (r_a + r_b),
///
/// exact for a face on a face, an edge on a face and an edge across an edge: a flat hull is flat
/// whatever its spacing. Invalid when the centres are not on the proper sides,
/// n . (c_b - c_a) <= 0.
Gap measure_gap_surface(const SphereSurface& a, const SphereSurface& b, bool prefer_a);

}  // namespace ice
