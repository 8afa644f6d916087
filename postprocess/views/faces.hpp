// SPDX-License-Identifier: GPL-3.0-or-later
/// Meshes prepared for drawing: fewer, larger polygons.
#pragma once

#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice::views {

/// A flat polygon, counter-clockwise seen from outside.
struct Face {
    std::vector<Vec3> corners;  ///< [m]
    Vec3 normal;                ///< outward, unit
    Vec3 center() const;        ///< mean of the corners
};

/// Merges neighbouring triangles whose normals agree within 0.5 degrees into polygons.
///
/// Where merged triangles surround a hole they stay triangles. Degenerate triangles vanish.
std::vector<Face> make_faces(const TriangleMesh& mesh);

/// A mesh cut by the plane z = `level` [m], corners on the plane shared by both parts.
struct CutMesh {
    TriangleMesh below, above;
    std::vector<std::pair<Vec3, Vec3>> section;  ///< pieces of the line where the plane cuts [m]
};
/// @param level [m]; a mesh on one side of it gives one empty part. A triangle in the plane is
///         below.
CutMesh cut_mesh(const TriangleMesh& mesh, double level);

/// Takes away the edges that change the shape least (quadric error, Garland and Heckbert 1997)
/// until `most` triangles are left. For pictures only: volume is not kept, nor is closedness where
/// the surface cannot be simplified so far. Meshes of up to `most` triangles (a count) come back
/// unchanged.
TriangleMesh simplify_mesh(const TriangleMesh& mesh, std::size_t most);

}  // namespace ice::views
