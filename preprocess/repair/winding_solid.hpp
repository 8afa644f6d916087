// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>

#include "common/geometry/triangle_mesh.hpp"
#include "preprocess/repair/choose_shells.hpp"

namespace ice {

/// A solid contoured anew from winding numbers.
struct WindingSolid {
    TriangleMesh mesh;     ///< closed, outward; region of the nearest triangle of the source
    double cell = 0.0;     ///< edge of the grid's cubes [m]: nothing smaller is kept
    double unclear = 0.0;  ///< share of the rows that leave through an opening [-]
};

/// Solid where the winding number of the surface is positive: whatever crosses, overlaps or repeats
/// counts once. With `envelope`, voids that cannot be reached from outside but through gaps
/// narrower than a cell are filled. The winding number is that of rows through the nodes of a grid,
/// about 200 cells along the longest side and two million nodes in all, or with cells of `finest`
/// [m] and up to eight million; between nodes the surface is found by steps of its own distance
/// from outside, so that smooth parts keep their place, and creases are put back (sharpen_contour).
/// Parts thinner than a cell are lost.
/// @pre the surface has no boundary as a chain; parts face outwards. Cost: about a second.
WindingSolid winding_solid(const TriangleMesh& mesh, SolidKind kind, double finest = 0.0);

/// How far vertices of a mesh lie outside a solid made of it [m], and where the farthest does.
std::pair<double, Vec3> farthest_outside(const TriangleMesh& mesh, const TriangleMesh& solid);

/// Space that parts enclose together without being one surface.
struct EnclosedVoids {
    double volume = 0.0;   ///< [m3], within a layer of a hundredth of the length
    double passage = 0.0;  ///< nothing wider leads there from outside [m]
};

/// Floods the outside of a closed surface on a grid of about 100 cells along the longest side and
/// measures the part that it does not reach.
EnclosedVoids enclosed_voids(const TriangleMesh& mesh);

/// Gives each triangle of `mesh` the region of the nearest triangle of `source`, and its names.
void copy_regions(const TriangleMesh& source, TriangleMesh& mesh);

}  // namespace ice
