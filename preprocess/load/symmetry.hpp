// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// Box around the vertices that triangles use [m]; empty for a mesh without triangles.
Eigen::AlignedBox3d bounding_box(const TriangleMesh& mesh);

/// How far the surface is from being its own mirror image about the middle of its extent along
/// `axis` (0, 1, 2 for x, y, z): 0 for a mirror-symmetric surface, of the order of 0.1 for a hull
/// seen from deck to keel.
///
/// With n the distance from that plane and a, b the two directions in it, measured from the box's
/// centre and in half extents, a symmetric surface of area A has
///
///     int n = int n a = int n b = int n a^2 = int n a b = int n b^2 = int n^3 = 0   (over A)
///
/// and the result is the largest of these means. They do not depend on how the surface is cut into
/// triangles, so a hull whose two sides are meshed differently passes, where a search for mirrored
/// vertices would fail. The integrals are exact (polynomials of degree 3). Open meshes are fine.
/// A shape could be lopsided and have all seven zero; a hull or floe is not that shape.
/// A mesh without area gives 0; one without extent along an axis is taken as one unit wide there.
/// Cost O(T).
double asymmetry(const TriangleMesh& mesh, int axis);

/// asymmetry() [-] below the first is symmetric, above the second is not, between them is doubt.
/// Measured: the two sides of a Wigley hull meshed with 24 and 48 stations 9e-4, with 16 and 32
/// 2e-3; hulls from deck to keel (the paper's two, a Wigley hull, a 100 m icebreaker) 0.16 to 0.31.
inline constexpr double kSymmetric = 0.01, kLopsided = 0.05;

}  // namespace ice
