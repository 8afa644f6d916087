// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "solver/level_ice/ice_sheet.hpp"

namespace ice {

/// Square cells over the plane.
struct EdgeGrid {
    Vec2 origin;  ///< a corner of cells [m]
    double cell;  ///< side [m], > 0
};

/// The ice within `reach` that can be met, cell by cell: of every cell that is not whole, or beside
/// one that is not, or touched by the box of a floe, the parts of the sheet in it. A floe may slide
/// below the unbroken ice. Nothing of two tiles is in common.
///
/// A part for which `can_be_filled` is false, as a strip that the grid cuts off, joins the part of
/// a cell beside it (at smaller x, larger x, smaller y, larger y, the first with which it has an
/// edge in common); where there is none, it is left out.
///
/// @param reach   in the sheet's axes [m]; nothing of the sheet within it gives no tiles
/// @param floes   boxes that may lie outside of the reach, in the same axes [m]
/// @return each loop from its corner with the smallest x, then y; in the order of the cells
std::vector<Loop> edge_tiles(const IceSheet& sheet, const EdgeGrid& grid,
                             const Eigen::AlignedBox2d& reach,
                             const std::vector<Eigen::AlignedBox2d>& floes,
                             const std::function<bool(const Loop&)>& can_be_filled);

}  // namespace ice
