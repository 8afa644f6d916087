// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "preprocess/fill/rows_inside.hpp"

namespace ice {

/// Clears the bits of lattice points nearer than `distance` [m] to the surface.
///
/// Each triangle visits the rows around it, the part of each row within its plane's slab, and there
/// the points that are still set. A point over the face is decided by its height, one clearly
/// beyond an edge by its distance from that edge's plane; what is left, and all that is within 1e-5
/// of `distance`, is decided by closest_on_triangle(), as SurfaceTree decides it. Triangles longer
/// than 32 pitches visit in pieces, so that a long sliver does not visit the whole box around it.
///
/// Bits are only ever cleared, so the order of the triangles cannot matter: same bits for any
/// thread count. Triangles without area count as the segments they are.
/// Cost O(triangles + points near the surface).
void clear_near(const TriangleMesh& mesh, const LatticeFrame& frame, double distance,
                LatticeBits& bits);

}  // namespace ice
