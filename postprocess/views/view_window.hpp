// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>

#include "postprocess/views/projection.hpp"

namespace ice::views {

/// The window of a view, in metres on the page, relative to the ship.
struct Window {
    double left, right, bottom, top;  ///< [m], left < right, bottom < top
};

/// Some water ahead, aft and below the hull; the same for every frame of a run. A hull without
/// length counts as 1 mm long.
///
/// @param hull its box in the ship frame [m]; @param floe_size largest radius of a floe [m]
/// @param half_breadth shown to each side [m], 0 for 0.45 ship lengths
/// @param waterline height of the water in the ship frame [m]
Window choose_window(const Eigen::AlignedBox3d& hull, ViewFrom from, double floe_size,
                     double half_breadth, double waterline);

}  // namespace ice::views
