// SPDX-License-Identifier: GPL-3.0-or-later
/// Mesh file -> triangles in the ship frame, metres. The only folder that uses assimp.
#pragma once

#include <filesystem>
#include <string>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// How a file's numbers become metres in the ship frame (x forward, y to port, z up).
struct ReadOptions {
    double scale = 1.0;          ///< metres per file unit
    std::string up = "z";        ///< file axis that points up: "y" or "z"
    std::string forward = "+x";  ///< direction, after `up`, of the bow: +x -x +y -y +z -z
    bool mirror_y = false;       ///< add the mirror image across y = 0 (half hulls)
};

/// Reads any format assimp knows (OBJ, STL, PLY, OFF, DAE, glTF, ...), with the parts' names.
///
/// assimp keeps coordinates as floats; the shortest decimal of the float is taken, which is what
/// the file said where it said it in seven digits or fewer.
///
/// Polygons are split into triangles; points and lines are dropped. Every node's transformation is
/// applied in double precision; a reflecting one turns its triangles over. A group, object or node
/// name becomes the region of its triangles; unnamed parts are region 0, "hull". The order of
/// `region_names` is that of the file. Vertices are as the file has them: not welded.
///
/// With `mirror_y`, triangles in the plane y = 0 go first (a half hull closed by its centre plane);
/// `centre_plane_dropped`, where given, takes their number.
///
/// @throws Error (exit code 2) naming the file: not found, not readable by assimp, no triangles,
///         NaN or infinite vertices (with their number), impossible up/forward pair.
TriangleMesh read_mesh(const std::filesystem::path& file, const ReadOptions& options,
                       std::int64_t* centre_plane_dropped = nullptr);

/// SHA-256 of a file's bytes, 64 hex digits. @throws Error (exit code 2) when it cannot be read.
std::string file_sha256(const std::filesystem::path& file);

}  // namespace ice
