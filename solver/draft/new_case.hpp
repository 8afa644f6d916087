// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace ice {

/// Arguments of `icesolve --new HULL [FIELD] [-o CASE]`.
struct NewCase {
    std::filesystem::path hull;   ///< a mesh, or a sphere set (.h5)
    std::filesystem::path field;  ///< a field (.h5), a specification (.toml), or empty
    std::filesystem::path out;    ///< the case; empty: named after the hull, in the working folder
    /// Options for spherize about the mesh: {"--units", "mm", "--up", "y"}.
    std::vector<std::string> mesh_options = {};
};

/// Writes a case for a hull and an ice field, and missing files beside it: a mesh becomes a sphere
/// set (by spherize, of some 12000 spheres), a specification a field (by icefield), no field one
/// for a ship of this size.
/// @return the case file
/// @throws Error (exit code 2) where one of those files exists, options of a mesh are given for a
///         sphere set, spherize refuses them, or the two do not make a case; (1) where a program
///         fails or a file cannot be written
std::filesystem::path write_new_case(const NewCase& wish);

}  // namespace ice
