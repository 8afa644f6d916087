// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// Reads a Wavefront OBJ with all the digits it holds, in the file's axes and units.
///
/// The format has a reader of its own because assimp keeps coordinates as floats: a hull drawn in
/// 12 digits would lose five, and volumes would be wrong in the eighth. A region is the name after
/// the latest `g` or `o`; an empty name, `default` and `off` are no name, and such a `g` falls back
/// to the object. Polygons are cut into triangles by triangulate_polygon(). Texture coordinates,
/// normals, materials, points, lines and free-form curves are skipped.
///
/// @throws Error (exit code 2) with file:line: a coordinate that is no finite number, a face with
///         fewer than three corners or with a vertex the file has not
TriangleMesh read_obj(const std::filesystem::path& file);

}  // namespace ice
