// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/scene/bodies.hpp"

#include <algorithm>

#include "common/math/ordered_products.hpp"

namespace ice {

void update_derived(Bodies& bodies, std::size_t i) {
    bodies.rotation[i] = bodies.orientation[i].toRotationMatrix();
    // The ship's motion is prescribed, or that of FreeShip: it has no momentum in these arrays.
    if (i == kShip) return;
    // No impulse moves held ice: its inverse mass is zero. Its momentum is kept, since ice may
    // drift at a constant velocity.
    if (bodies.held[i]) {
        bodies.velocity[i] = bodies.momentum[i] / bodies.mass[i];  // of ice that drifts
        if (!bodies.velocity[i].isZero(0.0)) bodies.held_drift = true;
        bodies.angular_velocity[i] = Vec3::Zero();
        bodies.inverse_mass[i] = 0.0;
        bodies.inverse_inertia_world[i] = Mat3::Zero();
        if (bodies.have_added_mass()) bodies.inverse_mass_excess[i] = Mat3::Zero();
        return;
    }
    const Mat3& r = bodies.rotation[i];
    // (2), and with added mass v = P / m + excess P, (P2)
    bodies.inverse_mass[i] = 1.0 / bodies.mass[i];
    bodies.inverse_inertia_world[i] = ordered_turned(r, bodies.inverse_inertia(i));
    bodies.velocity[i] = bodies.momentum[i] / bodies.mass[i];
    if (bodies.have_added_mass()) {
        bodies.inverse_mass_excess[i] = ordered_turned(r, bodies.inertia_row_of(i).inverse_excess);
        bodies.velocity[i] += ordered_product(bodies.inverse_mass_excess[i], bodies.momentum[i]);
    }
    bodies.angular_velocity[i] =
        ordered_product(bodies.inverse_inertia_world[i], bodies.angular_momentum[i]);
}

void release(Bodies& bodies, std::size_t i) {
    bodies.held[i] = Bodies::kFree;
    update_derived(bodies, i);
    // In ascending order, which is that of all sums over moving floes.
    const auto number = static_cast<std::int32_t>(i);
    const auto place = std::lower_bound(bodies.moving.begin(), bodies.moving.end(), number);
    if (place == bodies.moving.end() || *place != number) bodies.moving.insert(place, number);
}

void list_moving(Bodies& bodies) {
    bodies.moving.clear();
    for (std::size_t i = kShip + 1; i < bodies.size(); ++i)
        if (!bodies.held[i]) bodies.moving.push_back(static_cast<std::int32_t>(i));
}

double kinetic_energy(const Bodies& bodies) {
    double energy = 0.0;
    for (const std::int32_t i : bodies.moving)
        // P . v instead of m v^2 is right with added mass, too.
        energy += 0.5 * (bodies.momentum[i].dot(bodies.velocity[i]) +
                         bodies.angular_momentum[i].dot(bodies.angular_velocity[i]));
    return energy;
}

}  // namespace ice
