// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "common/formats/hdf5_file.hpp"

namespace ice {

/// Refuses a file of the project that is read as one of another kind: a field as a sphere set.
/// Files that state no format of the project, or the wanted one, pass.
/// @param wanted  its attribute `format`: "icesolve-spheres"
/// @param kind    in words: "a sphere set"
/// @throws Error (exit code 2) that names both kinds and the use of the file
void refuse_other_format(const std::filesystem::path& path, const Hdf5File& file,
                         const std::string& wanted, const std::string& kind);

}  // namespace ice
