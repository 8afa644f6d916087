// SPDX-License-Identifier: GPL-3.0-or-later
/// The seal of a file: the hash of its bytes, as 16 hexadecimal digits behind its end, which HDF5
/// does not read.
#pragma once

#include <filesystem>

namespace ice {

/// Seals a complete file. @throws Error (exit code 1) when it cannot be written
void add_seal(const std::filesystem::path& path);

/// True where the file ends in the hash of the bytes before; false where it is missing or too
/// short.
bool has_right_seal(const std::filesystem::path& path);

}  // namespace ice
