// SPDX-License-Identifier: GPL-3.0-or-later
/// Recognises a file of the project, or a mesh, that was given in place of another one.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ice {

struct Recognised {
    std::string what;    ///< "a mesh"
    std::string remedy;  ///< for such a file
};

/// A mesh (by its name), an HDF5 file of the project (by the format it states), or text in UTF-16.
/// @param text  of the whole file, also where it is none
/// @return nothing for a file that may be the right one
std::optional<Recognised> recognise_file(const std::filesystem::path& file, std::string_view text);

/// A file by the format that it states in its attribute: "icesolve-field".
/// @return nothing for a format that is none of the project's
std::optional<Recognised> recognise_format(const std::filesystem::path& file,
                                           std::string_view format);

/// A TOML file of another kind than `wanted`, which has none of the wanted kind's own tables.
/// @param file    for the remedy
/// @param names   keys and tables at its top level
/// @param wanted  a Schema's title: "icesolve case"
std::optional<Recognised> recognise_tables(const std::filesystem::path& file,
                                           const std::vector<std::string>& names,
                                           std::string_view wanted);

/// Remedy for a folder given as a file: names the files of that ending (".cfg") in it.
std::string look_into_folder(const std::filesystem::path& folder, std::string_view ending);

}  // namespace ice
