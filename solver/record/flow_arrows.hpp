// SPDX-License-Identifier: GPL-3.0-or-later
/// The water's flow at a few places, for the eye.
#pragma once

#include <vector>

#include "solver/scene/bodies.hpp"

namespace ice {

/// Velocities of the water for a ship at 1 m/s, at places that move with the ship but do not turn.
struct FlowArrows {
    std::vector<Vec3> point;     ///< from the water's surface above the ship's origin [m]
    std::vector<Vec3> velocity;  ///< by point, in ship speeds [-]
};

/// Some hundred places where the flow is 0.01 or more: even ones in the water's surface (2D: in the
/// section's plane) outside the hull, and along the wetted hull a little off it. None where the
/// scene has no flow around its hull.
FlowArrows flow_arrows(const Scene& scene);

}  // namespace ice
