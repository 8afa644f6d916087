// SPDX-License-Identifier: GPL-3.0-or-later
// The end of a step for floes, sections 2 and 7: the definition, one floe at a time.
// advance_floes_simd.cpp computes the same bits in lanes.
#include "common/math/ordered_products.hpp"
#include "solver/integrate/advance_floes.hpp"
#include "solver/integrate/rotation.hpp"

namespace ice::reference {

namespace {

void advance(Bodies& b, std::size_t i, const Advance& step) {
    const Vec3 change = b.angular_velocity[i] - step.angular_velocity_start[i];
    // (2) turned round: after the contacts the velocities are known and the momenta follow,
    // with added mass (P2). L gains I (w - w_start) only, so that a floe without a torque keeps
    // its bits.
    b.momentum[i] = b.mass[i] * b.velocity[i];
    if (b.have_added_mass())
        b.momentum[i] += ordered_turned(b.rotation[i], b.inertia_row_of(i).added, b.velocity[i]);
    if (!change.isZero(0.0))
        b.angular_momentum[i] += ordered_turned(b.rotation[i], b.inertia(i), change);

    // semi-implicit Euler: positions go with the new velocity; (12) moves the pose alone
    b.position[i] += step.dt * b.velocity[i] + step.corrections.shift[i];
    b.orientation[i] =
        advance_orientation(b.orientation[i], b.inverse_inertia(i), b.angular_momentum[i], step.dt);
    const Vec3& turn = step.corrections.turn[i];
    if (!turn.isZero(0.0))
        b.orientation[i] =
            ordered_normalized(ordered_product(exponential_map(turn), b.orientation[i]));
    update_derived(b, i);
}

}  // namespace

void advance_floes(Bodies& bodies, std::span<const std::int32_t> floes, const Advance& step) {
    for (const std::int32_t i : floes) advance(bodies, static_cast<std::size_t>(i), step);
}

}  // namespace ice::reference
