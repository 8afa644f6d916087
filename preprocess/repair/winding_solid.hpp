// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/geometry/triangle_mesh.hpp"
#include "preprocess/repair/choose_shells.hpp"

namespace ice {

/// A solid contoured anew from winding numbers.
struct WindingSolid {
    TriangleMesh mesh;     ///< closed, outward; region of the nearest triangle of the source
    double cell = 0.0;     ///< edge of the grid's cubes [m]: nothing smaller is kept
    double unclear = 0.0;  ///< of the solid's volume: winding number within 0.3 of a half
};

/// Solid where the winding number of the surface is over 0.5: whatever crosses, overlaps or repeats
/// counts once. With `envelope`, voids that cannot be reached from outside are filled. The surface
/// follows the source between the nodes of a grid (by bisection), about 200 cells along the longest
/// side and a million in all; edges sharper than a cell are rounded off.
/// @pre parts face outwards. Cost O(nodes log T), seconds.
WindingSolid winding_solid(const TriangleMesh& mesh, SolidKind kind);

/// Gives each triangle of `mesh` the region of the nearest triangle of `source`, and its names.
void copy_regions(const TriangleMesh& source, TriangleMesh& mesh);

}  // namespace ice
