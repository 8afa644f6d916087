// SPDX-License-Identifier: GPL-3.0-or-later
// A free ship that pushes ice for a long time: it stays stable, and overlaps stay small.
//
// Tolerances: 1e-3 m/s is ten of the solver's stops at 1e-4 m/s.
#include <catch2/catch.hpp>
#include <cmath>

#include "solver/record/solid_overlap.hpp"
#include "tests/support/make_worlds.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using namespace ice::test;

namespace {

// A box of 4 x breadth x 1 m without water, from rest, its bow at x = 2 m.
World pushing_ship(double mass, double breadth, double thrust,
                   std::initializer_list<Freedom> free) {
    Case p = empty_space(0.05);
    p.contact.iterations = 30;
    p.contact.tolerance = 1e-4;
    for (const Freedom k : free) p.ship.free[k] = true;
    p.ship.mass = mass;
    p.ship.centre_of_gravity = Vec3::Zero();
    p.ship.gyration = Vec3(1.0, 1.5, 1.5);
    p.propulsion.thrust = thrust;
    return plate_world(p, Vec3(4, breadth, 1), 0.1, 0.4, -0.5);
}

double deepest(const World& w) { return measure_overlaps(w.scene, {}).deepest; }

}  // namespace

TEST_CASE("fifty floes abreast are pushed for ten minutes by a ship of any mass",
          "[ship][contact][long]") {
    constexpr double kPush = 0.01;  // [m/s2], of ship and floes together
    const double share = GENERATE(0.2, 2.0, 20.0);
    const SphereSet block = make_box_set(Vec3(1, 0.9, 1), 0.1, 0.8);
    const double floes = 50.0 * 900.0 * build_shape(block, true).solid.volume;
    const double mass = share * floes;
    World w = pushing_ship(mass, 50.0, kPush * (mass + floes), {surge});
    const auto box = add_shape(w, block);
    for (int k = 0; k < 50; ++k)
        add_floe(w.scene, box, 900.0, Vec3(2.505, -24.5 + k, 0), Quaternion::Identity(), 0, false);
    double overlap = 0.0, spread = 0.0;
    while (w.time < 600.0 - 0.02) {
        step(w);
        if (w.steps % 40 != 0) continue;
        overlap = std::max(overlap, deepest(w));
        for (std::size_t i = 1; i <= 50 && w.time > 10.0; ++i)
            spread = std::max(spread, std::abs(w.scene.bodies.velocity[i].x() -
                                               w.scene.bodies.velocity[kShip].x()));
    }
    CAPTURE(share, overlap, spread);
    // thrust times time is their momentum, but for the rounding of 12 000 sums
    double momentum = mass * w.scene.bodies.velocity[kShip].x();
    for (std::size_t i = 1; i <= 50; ++i) momentum += w.scene.bodies.momentum[i].x();
    CHECK(momentum == Near(kPush * (mass + floes) * 600.0).epsilon(1e-10));
    CHECK(w.scene.bodies.velocity[kShip].x() == Near(kPush * 600.0).epsilon(1e-3));
    CHECK(spread < tolerance(1e-3));
    // as deep as floes may lie in each other before they are moved apart
    CHECK(overlap < kToleratedOverlap * 0.1);
}

TEST_CASE("a ship that presses on ice which is held goes no deeper with time", "[ship][held]") {
    World w = pushing_ship(3000.0, 2.0, 500.0, {surge, sway, heave, roll, pitch, yaw});
    w.parameters.floes[0].hold = Hold::always;
    w.parameters.contact.friction_ship_ice = 0.1;
    const auto box = add_shape(w, make_box_set(Vec3(1, 4, 3), 0.1, 0.4));
    const Quaternion inclined(Eigen::AngleAxisd(0.1, Vec3::UnitZ()));
    add_floe(w.scene, box, 900.0, Vec3(2.62, 0, 0), inclined, 0, true);
    while (w.time < 30.0) step(w);
    const Vec3 at = w.scene.bodies.position[kShip];
    CHECK(w.scene.bodies.velocity[kShip].norm() < tolerance(1e-6));
    while (w.time < 600.0) step(w);
    // the solver's tolerance of 1e-4 m/s would let it go 57 mm
    CHECK((w.scene.bodies.position[kShip] - at).norm() < tolerance(1e-5));
    CHECK(deepest(w) < tolerance(1e-5));
}
