// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/scene/step_start.hpp"

namespace ice {

void StepStart::take(const Bodies& bodies) {
    kinetic = kinetic_energy(bodies);
    velocity.resize(bodies.size(), Vec3::Zero());  // of held floes
    angular_velocity.resize(bodies.size(), Vec3::Zero());
    velocity[kShip] = bodies.velocity[kShip];
    angular_velocity[kShip] = bodies.angular_velocity[kShip];
    for (const std::int32_t i : bodies.moving) {
        velocity[i] = bodies.velocity[i];
        angular_velocity[i] = bodies.angular_velocity[i];
    }
}

}  // namespace ice
