// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "common/formats/spheres_report.hpp"
#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// Refuses a flat mesh, and a radius that no solid in a mesh can hold, before minutes go into the
/// mesh's repair.
/// @param surface    as read, T triangles [m]
/// @param radius     [m], > 0
/// @param dimension  3, or 2: discs of a section along y
/// @throws Error (exit code 2) naming the extents and the largest radius
void refuse_thin_mesh(const std::string& name, const TriangleMesh& surface, double radius,
                      int dimension);

/// True where the repairs completed half a hull by its mirror image.
bool was_mirrored(const SpheresReport& report);

/// Holds the solid against the mesh as it was read (compare_with_source; a half hull that the
/// repairs mirrored is mirrored first) and judges it: a warning with the number where a
/// surface is more than a radius from the other, or where parts of more than 0.1 % of the surface
/// were left out.
///
/// @param name     of the file, for messages
/// @param surface  as read, in metres and ship axes
/// @param wrapped  with --repair wrap: distances are warned of, never refused
/// @throws Error (exit code 2) where the 99th percentile within the ice belt exceeds the radius,
///         with the distance, its place and the remedy
void certify_solid(const std::string& name, TriangleMesh surface, const TriangleMesh& solid,
                   double radius, bool wrapped, SpheresReport& report);

}  // namespace ice
