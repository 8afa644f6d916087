// SPDX-License-Identifier: GPL-3.0-or-later
/// Sphere sets, fields and flows: HDF5 files that say whether a byte of them was changed.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "common/formats/hdf5_file.hpp"

namespace ice {

/// Writes a file in whole or not at all, with a seal (seal.hpp) and the attribute `sealed` = 1.
/// @param fill  writes all that is in it
/// @throws Error (exit code 1) when it cannot be written
void write_sealed(const std::filesystem::path& path, const std::function<void(Hdf5File&)>& fill);

/// Refuses a file that has the attribute and not the right seal. Files without the attribute pass:
/// those of earlier versions, and of other tools, which delete the attribute when they change one.
/// @param maker  the program that makes such files, for the remedy
/// @throws Error (exit code 2)
void refuse_changed(const std::filesystem::path& path, const Hdf5File& file,
                    const std::string& maker);

}  // namespace ice
