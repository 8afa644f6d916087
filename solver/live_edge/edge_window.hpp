// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "common/geometry/loop_area.hpp"

namespace ice {

/// The impulse of one contact on the edge of the ice in a step.
struct EdgeLoad {
    Vec2 at;         ///< where [m]
    double down;     ///< impulse downwards, friction included, of (26) [N s]
    double normal;   ///< normal impulse [N s]
    double closing;  ///< normal impulse times closing speed [N m]
    Vec2 push;       ///< normal impulse on the ice, seen from above [N s]
};

/// A stretch of edge and the load on it.
struct EdgeWindow {
    Vec2 at;         ///< centre of the downward impulses [m]
    Vec2 inwards;    ///< unit vector along the push
    double down;     ///< impulse downwards [N s], > 0
    double closing;  ///< mean closing speed along the contacts' normals [m/s]
    /// Mean closing speed along the level parts of the normals, a ship's along its outline's normal
    /// [m/s].
    double normal_speed;
};

/// Loads that act on one piece of ice together, the heaviest first. None for no loads.
///
/// Around each load the loads within `radius` [m] are summed. The largest sum is the first window;
/// ties go to the earlier load. Its loads are left out of the next one. Windows that do not press
/// downwards, and those whose push has no direction seen from above, are none.
std::vector<EdgeWindow> edge_windows(std::vector<EdgeLoad> loads, double radius);

}  // namespace ice
