// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// Exact integrals over a solid of unit density. In 2D per metre of breadth.
struct MassProperties {
    double volume = 0.0;           ///< [m3]; negative for a mesh turned inside out
    double area = 0.0;             ///< of the surface [m2]
    Vec3 centroid = Vec3::Zero();  ///< [m]
    Mat3 inertia = Mat3::Zero();   ///< about the centroid, unit density [m5]
};

/// Integrates over the volume inside a closed mesh.
///
/// Each triangle spans a tetrahedron with a reference point (the box centre, so that a mesh far
/// from its origin loses no digits); the signed tetrahedra add up to the solid. For a tetrahedron
/// with one corner at the reference, volume V and the other corners a, b, c, s = a + b + c:
///
///     int x dV     = V s / 4
///     int x x^T dV = V / 20 (a a^T + b b^T + c c^T + s s^T)
///
/// Degenerate triangles add nothing; an empty mesh gives zeros. An open mesh gives numbers without
/// meaning: check it first. Cost O(T).
MassProperties measure_mass(const TriangleMesh& mesh);

/// A property that no solid can have, in words, or nothing: a volume, area or moment of inertia
/// that is not positive or no number, an inertia that is not symmetric, or one principal moment
/// above the sum of the other two (I_1 + I_2 - I_3 = 2 int x_3^2 dV >= 0).
/// @return "" for a solid without fault, else the first fault with its value
std::string fault_of(const MassProperties& solid);

}  // namespace ice
