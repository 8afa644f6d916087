// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/integrate/integrate.hpp"

#include "common/base/assert.hpp"
#include "solver/scene/moving_floes.hpp"

namespace ice {

void advance(Scene& scene, const Advance& step) {
    ICE_ASSERT(step.angular_velocity_start.size() == scene.bodies.size());
    ICE_ASSERT(step.corrections.shift.size() == scene.bodies.size());
    Bodies& b = scene.bodies;
    // the ship's orientation, where it may turn, is ShipMotion's
    b.position[kShip] += step.dt * b.velocity[kShip];
    for_each_group(b, [&](std::span<const std::int32_t> floes, std::size_t) {
        advance_floes(b, floes, step);
    });
    for (std::size_t i = 1; b.held_drift && i < b.size(); ++i)
        if (b.held[i]) b.position[i] += step.dt * b.velocity[i];
}

}  // namespace ice
