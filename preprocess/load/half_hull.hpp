// SPDX-License-Identifier: GPL-3.0-or-later
/// Meshes that hold one side of a hull only: recognised and completed.
#pragma once

#include <string>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// How a mesh lies about the centre plane y = 0 of the ship frame.
struct HalfHull {
    enum class Kind {
        none,   ///< not half a hull
        open,   ///< half a hull, open along y = 0: only its mirror image closes it
        closed  ///< half a hull, closed by a flat face in y = 0: a solid, but half of one
    };
    Kind kind = Kind::none;
    bool port = true;                         ///< it lies at y >= 0; starboard otherwise
    std::int64_t open_edges = 0;              ///< open edges that lie in y = 0
    std::int64_t centre_plane_triangles = 0;  ///< triangles that lie in y = 0

    explicit operator bool() const { return kind != Kind::none; }
    /// "this looks like half a hull (everything is on the port side of y = 0, 12 open edges lie in
    /// that plane)"; empty when it does not.
    std::string text() const;
};

/// Tells half a hull from a whole one.
///
/// Half a hull lies on one side of y = 0 (to 5e-7 of the box's diagonal: a vertex and its image
/// are then within the 1e-6 that weld() merges) and is cut there: open edges, or flat triangles, in
/// that plane reach over at least half the mesh's length and height. Open edges are enough; small
/// flat parts, such as a rudder, do not matter. Where triangles close the plane, the mesh must also
/// be at least 2.5 times as long as broad (hulls are 1.5 times and more, their halves 3), and
/// unlike its own mirror image about the middle of its breadth: a barge or a floe drawn from y = 0
/// to its full breadth is a whole solid with one side in that plane. The closed half of a
/// straight-sided barge therefore counts as whole: nothing in the mesh distinguishes it from a
/// barge of half the breadth. Where both are found, the plane is closed but torn: none, until it is
/// mended.
///
/// Equal vertices need not be welded. Open edges elsewhere (an open deck) do not matter. Empty and
/// flat meshes are none. Cost O(T log T); O(T) for a mesh on both sides of the plane.
///
/// @param axis  normal of the plane: 1 for y = 0 of the ship frame; others for meshes whose axes
///              are still the file's
HalfHull looks_like_half_hull(const TriangleMesh& mesh, int axis = 1);

/// Half a hull that its mirror image would close along y = 0: drop_centre_plane(), then
/// add_mirror_image(), then weld().
bool is_open_half(const TriangleMesh& mesh);

/// Removes triangles that lie in y = 0 (same tolerance): they close half a hull there, but would be
/// inside the whole one. @return how many
std::int64_t drop_centre_plane(TriangleMesh& mesh);

/// Appends the mirror image about y = 0, turned so that it faces outwards as the original does.
/// Regions are kept. Vertices with y = 0 are shared; the rest of the seam is left to weld().
void add_mirror_image(TriangleMesh& mesh);

}  // namespace ice
