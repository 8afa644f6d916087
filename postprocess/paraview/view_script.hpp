// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace ice::paraview {

/// A Python script for ParaView that opens run.xdmf beside it: ice coloured by its state, the hull
/// by its mean load, arrows for the contacts, the water's plane.
/// @param folder  of the files, for ParaView versions that do not tell a script where it is
/// @param force_unit  ending of forces' names, "_N" or in 2D "_N_per_m"
std::string view_script(const std::filesystem::path& folder, const std::string& force_unit);

}  // namespace ice::paraview
