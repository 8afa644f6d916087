// SPDX-License-Identifier: GPL-3.0-or-later
/// The three geometric steps of a section, done by CGAL.
#pragma once

#include <array>
#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// Closed polylines [m] in which the plane y = `offset` [m] cuts the mesh, y set to 0; the last
/// point is not repeated. Vertices and edges in the plane are decided exactly.
std::vector<std::vector<Vec3>> cut_by_plane(const TriangleMesh& mesh, double offset);

/// Turns loops so that outer ones run anticlockwise in x-z and loops inside an odd number of others
/// clockwise.
std::vector<std::vector<Vec3>> orient_loops(std::vector<std::vector<Vec3>> loops);

/// Triangles that fill the loops (holes left out), anticlockwise in x-z. Indices count the loops'
/// points one after the other.
std::vector<std::array<std::int32_t, 3>> triangulate(const std::vector<std::vector<Vec3>>& loops);

}  // namespace ice
