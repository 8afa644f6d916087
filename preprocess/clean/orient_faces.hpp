// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// Turns triangles so that neighbours face the same side, part by part: a walk over the edges of
/// exactly two triangles. In each part the side of the larger area wins; which side is outside is
/// not decided here. A surface with one side only (Moebius) keeps inconsistent edges.
/// @return triangles turned. Cost O(T). @pre the mesh is welded
std::int64_t orient_faces(TriangleMesh& mesh);

/// Turns all triangles over: the volume changes its sign.
void flip(TriangleMesh& mesh);

}  // namespace ice
