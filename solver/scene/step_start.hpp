// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solver/scene/bodies.hpp"

namespace ice {

/// Motion at the start of a step: changes of momentum and the ledger's work are measured from it.
struct StepStart {
    double kinetic = 0.0;  ///< kinetic energy of the free floes [J]
    /// Per body [m/s], [rad/s] in world axes, after floes were released; of held ice its drift.
    std::vector<Vec3> velocity, angular_velocity;
    std::vector<std::int32_t> taken;  ///< the ship and the floes that moved: other ones are zero

    /// Takes velocities and kinetic energy from the bodies, which are those of the last call. The
    /// time follows the bodies that move, not those that are held, unless held ice drifts.
    void take(const Bodies& bodies);
};

}  // namespace ice
