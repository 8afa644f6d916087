// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "preprocess/load/import_scene.hpp"

namespace ice {

/// An imported mesh as bytes, in which a child process hands it over; nothing is rounded. They are
/// for the same program on the same machine, not for a file.
std::string to_bytes(const ImportedMesh& imported);

/// The mesh of to_bytes().
/// @throws std::runtime_error when the bytes end early
ImportedMesh from_bytes(std::string_view bytes);

}  // namespace ice
