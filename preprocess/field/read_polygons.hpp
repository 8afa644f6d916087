// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "preprocess/field/outline.hpp"

namespace ice {

/// A polygon as its file states it.
struct NamedOutline {
    std::string name;  ///< "floe 7", "feature 3": for messages
    Outline corners;   ///< in the file's units and order, the first perhaps repeated
};

/// Reads GeoJSON (Polygon, MultiPolygon, features and collections of them; other geometries are
/// passed over) or CSV (rows floe, x, y; neighbouring rows of one floe are its corners).
///
/// @param holes  increased by the count of holes of polygons, which are left out
/// @throws Error (exit code 2) naming file and place
std::vector<NamedOutline> read_polygons(const std::filesystem::path& file, std::size_t& holes);

}  // namespace ice
