// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/scene/step_start.hpp"

namespace ice {

void StepStart::take(const Bodies& bodies) {
    kinetic = kinetic_energy(bodies);
    velocity = bodies.velocity;  // of held floes, too
    // zero of ice that is held: a slot of level ice that moved may hold the edge now
    angular_velocity.assign(bodies.size(), Vec3::Zero());
    angular_velocity[kShip] = bodies.angular_velocity[kShip];
    for (const std::int32_t i : bodies.moving) {
        angular_velocity[i] = bodies.angular_velocity[i];
    }
}

}  // namespace ice
