// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/scene/step_start.hpp"

namespace ice {

void StepStart::take(const Bodies& bodies) {
    kinetic = kinetic_energy(bodies);
    velocity.resize(bodies.size(), Vec3::Zero());
    angular_velocity.resize(bodies.size(), Vec3::Zero());
    // a slot of level ice that moved may hold the edge now
    for (const std::int32_t i : taken) velocity[i] = angular_velocity[i] = Vec3::Zero();
    taken = bodies.moving;
    taken.push_back(kShip);
    for (const std::int32_t i : taken) {
        velocity[i] = bodies.velocity[i];
        angular_velocity[i] = bodies.angular_velocity[i];
    }
    for (std::size_t i = 1; bodies.held_drift && i < bodies.size(); ++i)
        if (bodies.held[i]) velocity[i] = bodies.velocity[i];
}

}  // namespace ice
