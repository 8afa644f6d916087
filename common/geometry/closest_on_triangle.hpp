// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// The point of a triangle nearest to some point.
struct TrianglePoint {
    Vec3 point;   ///< [m]
    int feature;  ///< where it lies: 0-2 corners, 3-5 edges ab, bc, ca, 6 the face
};

/// Nearest point of the triangle a, b, c to p, by its Voronoi regions, corner by corner and edge by
/// edge (Ericson, Real-Time Collision Detection, section 5.1.5). A triangle without area is treated
/// as the segment or point it is. Lengths [m]; of equally near features the corner counts first,
/// then the edge.
inline TrianglePoint closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b,
                                         const Vec3& c) {
    const Vec3 ab = b - a, ac = c - a, ap = p - a;
    const double d1 = ab.dot(ap), d2 = ac.dot(ap);
    if (d1 <= 0.0 && d2 <= 0.0) return {a, 0};
    const Vec3 bp = p - b;
    const double d3 = ab.dot(bp), d4 = ac.dot(bp);
    if (d3 >= 0.0 && d4 <= d3) return {b, 1};
    const Vec3 cp = p - c;
    const double d5 = ab.dot(cp), d6 = ac.dot(cp);
    if (d6 >= 0.0 && d5 <= d6) return {c, 2};
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return {a + d1 / (d1 - d3) * ab, 3};
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0)
        return {b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b), 4};
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return {a + d2 / (d2 - d6) * ac, 5};
    // inside the face: the projection on its plane, more exact than barycentric sums
    const Vec3 n = ab.cross(ac);
    return {p - n * (n.dot(ap) / n.squaredNorm()), 6};
}

}  // namespace ice
