// SPDX-License-Identifier: GPL-3.0-or-later
// Loads of the caller: motion in closed form, work in the ledger, no change where they are zero.
//
// Tolerances: 1e-9 is rounding of the same 200 sums, of a difference of energies.
#include <catch2/catch.hpp>

#include "solver/run/make_world.hpp"
#include "solver/run/measure_imbalance.hpp"
#include "tests/support/make_sphere_sets.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;
using ice::test::tolerance;

namespace {

constexpr double kStep = 0.01;

// One floe that floats in still water without drag, far from the ship at rest.
World one_floe(double drag = 0.0) {
    Case p;
    p.time_step = kStep;
    p.speed_table = {{0.0, 0.0}};
    p.drag_coefficient = drag;
    World world = make_world(p, test::make_box_set({4.0, 2.0, 1.0}, 0.1, 0.2));
    const auto shape = add_floe_shape(world, test::make_box_set({1.0, 0.8, 0.3}, 0.05, 0.1));
    add_floe(world, shape, {.position = {30.0, 0.0, std::numeric_limits<double>::quiet_NaN()}});
    world.applied_loads.resize(world.scene.bodies.size());
    return world;
}

}  // namespace

TEST_CASE("a steady force and a moment about the vertical move a floe as Newton and Euler say") {
    World world = one_floe();
    const Bodies& bodies = world.scene.bodies;
    const Vec3 force(120.0, -40.0, 0.0);
    world.applied_loads[1] = {force, Vec3(0.0, 0.0, 7.0)};
    constexpr int kSteps = 200;
    for (int k = 0; k < kSteps; ++k) {
        const Momenta before = momenta_of(world);
        step(world);
        CHECK(measure_imbalance(before, world).worst() < kBalanceTolerance);
    }
    const double time = kSteps * kStep;
    const Vec3 velocity = force * time / bodies.mass[1];
    // sums of 200 equal changes: rounding of each, 1e-16, times their number
    CHECK((bodies.velocity[1] - velocity).head<2>().norm() < tolerance(1e-12) * velocity.norm());
    const double spin = 7.0 * time / bodies.inertia(1)(2, 2);
    CHECK(std::abs(bodies.angular_velocity[1].z() - spin) < tolerance(1e-9) * spin);
    // all of the work is motion: F . v t / 2 and T w t / 2
    const double work = 0.5 * bodies.mass[1] * velocity.squaredNorm() + 0.5 * 7.0 * time * spin;
    CHECK(world.ledger.applied_work == Near(work).epsilon(1e-9));
    CHECK(std::abs(world.ledger.residual(potential_energy(world.scene, world.parameters))) <
          tolerance(1e-9) * work);
}

TEST_CASE("loads of the ship and of held floes are not taken") {
    World world = one_floe();
    world.scene.bodies.held[1] = 1;
    list_moving(world.scene.bodies);
    update_derived(world.scene.bodies, 1);
    const Vec3 begun = world.scene.bodies.position[1];
    world.applied_loads = {{Vec3(1e5, 0, 0), Vec3::Zero()}, {Vec3(1e5, 0, 0), Vec3(0, 0, 1e4)}};
    for (int k = 0; k < 10; ++k) step(world);
    CHECK(world.scene.bodies.position[1] == begun);
    CHECK(world.scene.bodies.position[kShip] == Vec3::Zero());
    CHECK(world.ledger.applied_work == 0.0);
}

TEST_CASE("loads of zero change no bit, and a load taken back acts no more") {
    World with = one_floe(1.0), without = one_floe(1.0);
    without.applied_loads.clear();
    for (World* world : {&with, &without})
        world->scene.bodies.momentum[1] = Vec3(50.0, 20.0, -30.0);
    const auto go_on = [](World& world, int steps) {
        for (int k = 0; k < steps; ++k) step(world);
    };
    go_on(with, 50);
    go_on(without, 50);
    CHECK(with.scene.bodies.position[1] == without.scene.bodies.position[1]);
    CHECK(with.scene.bodies.momentum[1] == without.scene.bodies.momentum[1]);

    with.applied_loads[1].force = Vec3(0.0, 500.0, 0.0);
    go_on(with, 5);
    with.applied_loads[1].force.setZero();
    const double entered = with.ledger.applied_work;
    CHECK(entered > 0.0);
    go_on(with, 5);
    CHECK(with.ledger.applied_work == entered);
}
