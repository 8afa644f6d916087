// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace ice {

/// Signs that a mesh file ends too early, from its text alone: an OBJ whose last vertices no face
/// uses (writers list vertices first), or whose last line is a piece of a face; an ASCII STL
/// without its closing word. Readers take such files without complaint, and the missing faces
/// look like an open deck. A PLY or OFF without a line end at its end has perhaps lost digits
/// of its last number.
/// @return "the file seems cut off: ...", or nothing; nothing for files it cannot open. Cost: one
///         read of the file
std::string looks_cut_off(const std::filesystem::path& file);

/// Refuses PLY, OFF and binary STL files that are shorter than their header promises: assimp 5.2
/// does not refuse PLY and OFF files but crashes on them. Other formats, and headers it does not
/// understand, pass.
/// @throws Error (exit code 2) naming the file, the promised and the present length
void refuse_short_file(const std::filesystem::path& file);

}  // namespace ice
