// SPDX-License-Identifier: GPL-3.0-or-later
/// Mesh file -> triangles in the ship frame, metres. The only folder that uses assimp.
#pragma once

#include <filesystem>
#include <string>

#include "common/geometry/triangle_mesh.hpp"
#include "preprocess/load/choose_frame.hpp"

namespace ice {

/// Reads OBJ, STL, PLY, OFF, DAE, glTF, GLB and FBX, with the parts' names, also compressed
/// (hull.stl.gz).
///
/// assimp keeps coordinates as floats; the shortest decimal of the float is taken, which is the
/// file's number where that has seven digits or fewer.
///
/// Polygons are split into triangles; points and lines are dropped. Every node's transformation is
/// applied in double precision; a reflecting one turns its triangles over. A group, object or node
/// name becomes the region of its triangles; unnamed parts are region 0, "hull". The order of
/// `region_names` is that of the file. Vertices are as the file has them: not welded.
///
/// Units and axes: options, else the file's metadata, else a guess (choose_frame()).
///
/// With `mirror_y`, triangles in the plane y = 0 go first (a half hull closed by its centre plane),
/// then the mirror image is added; a mesh that lies on both sides of it gets a warning.
///
/// @param notes  where given, receives values from the file, guesses and dropped parts
/// @throws Error (exit code 2) naming the file: not found, not readable by assimp, damaged gzip,
///         no triangles, NaN or infinite vertices (with their number), impossible up/forward pair
TriangleMesh read_mesh(const std::filesystem::path& file, const ReadOptions& options,
                       ReadNotes* notes = nullptr);

/// SHA-256 of a file's bytes, 64 hex digits. @throws Error (exit code 2) when it cannot be read.
std::string file_sha256(const std::filesystem::path& file);

}  // namespace ice
