// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// Shrink-wraps a surface whatever its faults (CGAL Alpha_wrap_3): a closed outward manifold around
/// all triangles. It enters every opening wider than about 2 alpha and rounds off smaller details.
/// @param alpha  [m] > 0   @param offset  [m] > 0: distance of the wrap outside the surface
/// @return the wrap; empty when CGAL fails. Regions are not set.
TriangleMesh alpha_wrap(const TriangleMesh& mesh, double alpha, double offset);

/// The wrap laid back towards the surface: each vertex within 2 offsets of it moves nine tenths of
/// the way to its nearest point, so that the offset adds little volume, unless triangles would
/// cross. Regions follow.
TriangleMesh wrap_solid(const TriangleMesh& mesh, double alpha, double offset);

}  // namespace ice
