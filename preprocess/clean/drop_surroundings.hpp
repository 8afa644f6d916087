// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// Leaves out the domain of a flow solver: parts that are a box along the axes around
/// all else, at least half as large again in two directions, and flat parts along the axes that
/// reach beyond all else by a fifth in both of their directions (a sea plane, a wall). A box around
/// nothing but boxes must be three times as large as those in each direction: a barge has tanks.
/// @return one text for each part left out: its kind and size [m]; empty where none is
/// @pre the mesh is welded. Cost O(T)
std::vector<std::string> drop_surroundings(TriangleMesh& mesh);

}  // namespace ice
