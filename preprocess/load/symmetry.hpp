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

/// asymmetry() below this is symmetric: left and right sides of curved hulls with unlike triangles
/// differ by 1e-4 or less, the fore and aft halves of a hull by 1e-2 or more.
inline constexpr double kSymmetric = 2e-3;

}  // namespace ice
