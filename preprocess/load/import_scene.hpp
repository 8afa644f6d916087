// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "common/geometry/triangle_mesh.hpp"
#include "preprocess/load/choose_frame.hpp"

namespace ice {

/// A file's triangles in its own axes and units, and its statements on these.
struct ImportedMesh {
    TriangleMesh mesh;
    FileFrame frame;
};

/// Reads a file with assimp; one that ends in ".gz" is unpacked in memory first (gunzip()).
///
/// Measured with assimp 5.2.5, which is why the scene is walked here and not flattened by assimp:
///   - Collada: the unit (a float) and a rotation to y up are put into the root node, which Collada
///     itself does not have. Both are read from there as metadata and not applied, so that a scale
///     or axis from the command line replaces them instead of coming on top.
///   - FBX: neither unit nor axes are applied; they are in the scene's metadata. UnitScaleFactor
///     is in centimetres.
///   - glTF: nothing is applied; metres, y up and front +z by its specification (2.0, section 3.4).
///   - OBJ, STL, PLY, OFF: no units, no axes.
///
/// assimp crashes, or never ends, on some damaged files: it reads them in a child process, which
/// hands the mesh over (read_in_child()). It opens no file outside the mesh's own folder: a
/// material library elsewhere is left out, a glTF buffer elsewhere is an error.
///
/// @throws Error (exit code 2) naming the file, when its name has the ending of no format that is
///         read, when assimp or gunzip() cannot read it, when reading it crashes, takes too long or
///         more memory than ReadBounds::for_size() grants
ImportedMesh import_scene(const std::filesystem::path& file);

}  // namespace ice
