// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "preprocess/fill/rows_inside.hpp"

namespace ice {

/// Clears the bits of lattice points inside a solid that are nearer than `distance` [m] to its
/// surface.
///
/// Each triangle visits the rows around it, the part of each row within the inner half of its
/// plane's slab, and there the points that are still set: the nearest triangle of a point inside
/// has the point on its inner side, or shares the nearest corner or edge with one that has.
/// measure_distances() measures several points at a time; points within 1e-5 of the squared
/// distance is decided again by closest_on_triangle(), as SurfaceTree decides it, and so are all
/// points near slivers, whose normals are rounding. Triangles longer than 32 pitches visit in
/// pieces, so that a long one does not visit the whole box around it.
///
/// Bits are only ever cleared, so the order of the triangles cannot matter: same bits for any
/// thread count. Cost O(triangles + points near the surface).
/// @pre the mesh is closed, outward oriented and does not cross itself; set bits are inside it
void clear_near(const TriangleMesh& mesh, const LatticeFrame& frame, double distance,
                LatticeBits& bits);

}  // namespace ice
