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

}  // namespace ice
