// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// A part of the surface that is missing.
struct Opening {
    Vec3 at = Vec3::Zero();  ///< mean of its corners [m]
    double perimeter = 0.0;  ///< [m]
    std::int64_t edges = 0;  ///< count
};

/// Faults that keep a triangle mesh from being the surface of a solid.
struct SolidDiagnosis {
    std::int64_t open_edges = 0;          ///< edges with one triangle
    std::int64_t crowded_edges = 0;       ///< edges with three or more triangles
    std::int64_t inconsistent_edges = 0;  ///< both triangles run the same way along the edge
    std::int64_t intersecting_pairs = 0;  ///< triangles that cross; counted when the rest is good
    std::int64_t parts = 0;               ///< connected pieces of surface
    Vec3 example = Vec3::Zero();          ///< a point on the first fault found [m]
    double volume = 0.0;                  ///< signed [m3]; negative: inside out
    bool inside_out = false;              ///< good but for its orientation

    bool closed() const { return open_edges == 0 && crowded_edges == 0 && inconsistent_edges == 0; }
    bool good() const { return closed() && intersecting_pairs == 0 && volume > 0.0; }
    /// One line per fault, "12 open edges, the first at x = ..., y = ..., z = ...".
    std::string text() const;
};

/// Counts edges by their triangles and, for a closed mesh, crossing triangles (CGAL).
/// @pre the mesh is welded
SolidDiagnosis diagnose_solid(const TriangleMesh& mesh);

/// The part of diagnose_solid() that tests edges only: cheap.
SolidDiagnosis diagnose_edges(const TriangleMesh& mesh);

/// The openings, the longest first. @pre the mesh is welded and its faces are oriented
std::vector<Opening> find_openings(const TriangleMesh& mesh);

/// Several lines on a mesh as it was read (welded here, otherwise untouched): size, parts, edges,
/// openings with place and length, crossing triangles, volume, half hull. For --check.
std::string describe_mesh(TriangleMesh mesh);

}  // namespace ice
