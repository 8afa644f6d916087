// SPDX-License-Identifier: GPL-3.0-or-later
/// The ship's course through the sheet of level ice, seen from above, as both lie at the start.
#pragma once

#include <Eigen/Geometry>

#include "solver/step/step.hpp"

namespace ice {

/// Infinite where the ship never meets the sheet, because it passes beside it or away from it.
struct SheetCourse {
    double clearance = 0.0;    ///< from the hull's outline to the sheet [m]; 0: the hull lies in it
    double through = 0.0;      ///< until the outline's foremost point is beyond the sheet [m]
    bool beside = false;       ///< whether the course passes beside the sheet
    double to_clear = 0.0;     ///< shift along x that puts the ship just before the sheet [m]
    Eigen::AlignedBox2d hull;  ///< around the hull's outlines at the ice's faces [m]
};

/// Measures it from the hull's outlines at the ice's faces (hull_outlines): a bulwark ahead of them
/// meets no ice. In 2D y is not used.
/// @param direction  +1 or -1: the ship moves along x or against it
/// @pre the world has a sheet, and ice has not drifted yet
SheetCourse measure_sheet_course(const World& world, double direction);

}  // namespace ice
