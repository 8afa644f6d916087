// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace ice {

/// Refuses PLY, OFF and binary STL files that are shorter than their header promises: assimp 5.2
/// does not refuse PLY and OFF files but crashes on them. Other formats, and headers it does not
/// understand, pass.
/// @throws Error (exit code 2) naming the file, the promised and the present length
void refuse_short_file(const std::filesystem::path& file);

}  // namespace ice
