// SPDX-License-Identifier: GPL-3.0-or-later
// A free ship: momentum and energy of ship and floes.
//
// Tolerances: 1e-12 is rounding of a few hundred momenta, 1e-16 of their size each; 1e-9 that of a
// sum of works of both signs.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "solver/run/measure_imbalance.hpp"
#include "tests/support/ships_in_ice.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using namespace ice::test;

namespace {

Vec3 momentum_of(const World& w) {
    Vec3 sum = w.scene.bodies.momentum[kShip];
    for (const std::int32_t i : w.scene.bodies.moving) sum += w.scene.bodies.momentum[i];
    return sum;
}

}  // namespace

TEST_CASE("ship and floes together keep their momentum", "[ship][contact][balance]") {
    World w = box_ship(2000.0, 2.0, {surge, sway, heave, roll, pitch, yaw});
    w.parameters.contact.friction_ship_ice = 0.2;
    w.parameters.contact.iterations = 30;
    w.parameters.contact.tolerance = 1e-4;
    w.parameters.ship.added_mass = {0.1, 0.6, 0.9, 0.2, 0.7, 0.3};
    const auto box = add_shape(w, make_box_set(Vec3(0.8, 0.6, 0.3), 0.05, 0.1));
    for (int k = 0; k < 8; ++k)
        add_floe(w.scene, box, 900.0,
                 Vec3(2.6 + 0.9 * (k / 3), -0.7 + 0.7 * (k % 3), 0.1 * (k % 2)),
                 Quaternion(Eigen::AngleAxisd(0.2 * k, Vec3(1, 2, 3).normalized())), 0, false);
    step(w);
    double impulse = 0.0;
    for (int k = 0; k < 150; ++k) {
        // the ship's own momentum turns with its added mass: within a step it balances
        const Vec3 mass_velocity = w.scene.bodies.velocity[kShip];
        Vec3 floes = momentum_of(w) - w.scene.bodies.momentum[kShip];
        step(w);
        const Bodies& b = w.scene.bodies;
        const Vec3 gained = momentum_of(w) - b.momentum[kShip] - floes;
        const Vec3 lost = b.ship.inverse_mass.inverse() * (b.velocity[kShip] - mass_velocity);
        const Vec3 sum = gained + lost;
        double size = 0.0;
        for (const Constraint& c : w.constraints)
            if (c.a == 0) size += c.total_normal() + c.total_tangent().norm();
        impulse += size;
        // rounding: of momenta of some tons at m/s, 1e-16 each
        REQUIRE(sum.norm() <= tolerance(1e-12) * (size + 2000.0));
    }
    CHECK(impulse > 100.0);
    CHECK(w.scene.bodies.angular_velocity[kShip].norm() > 1e-3);
}

TEST_CASE("every step of a free ship in ice balances, with its lines, held ice and jams",
          "[ship][balance]") {
    for (const double pressure : {2e5, 1e4, std::numeric_limits<double>::infinity()}) {
        World w = hauled_ride(pressure, {surge, sway, heave, roll, pitch, yaw});
        step(w);
        bool crushed = false, held = false;
        for (int k = 0; k < 120; ++k) {
            const Momenta before = momenta_of(w);
            step(w);
            REQUIRE_NOTHROW(require_balance(before, w));
            for (const Constraint& c : w.constraints) {
                if (c.total_normal() == 0.0) continue;
                crushed = crushed || c.is_at_bound();
                held = held || (c.a == 0 && w.scene.bodies.held[c.b]);
            }
        }
        CAPTURE(pressure);
        CHECK(crushed == !std::isinf(pressure));
        CHECK(held);
    }
}

TEST_CASE("a free ship that is off by 1e-9 m/s is caught", "[ship][balance]") {
    World w = hauled_ride(2e5, {surge, yaw});
    for (int k = 0; k < 60; ++k) step(w);
    const Momenta before = momenta_of(w);
    step(w);
    REQUIRE_NOTHROW(require_balance(before, w));
    Bodies& b = w.scene.bodies;
    SECTION("of its velocity") { b.velocity[kShip].x() += 1e-9; }
    SECTION("of its turning") { b.angular_velocity[kShip].z() += 1e-9; }
    CHECK_THROWS_WITH(require_balance(before, w), Catch::Contains("step 61, ship"));
}

TEST_CASE("ship and floes gain what loads, thrust, lines and held ice give", "[ship][balance]") {
    World w = hauled_ride(2e5, {surge, sway, heave, roll, pitch, yaw});
    step(w);
    for (int k = 0; k < 150; ++k) {
        const Vec3 ship_before = w.scene.bodies.velocity[kShip];
        const std::vector<Vec3> before = w.scene.bodies.momentum;
        step(w);
        const Bodies& b = w.scene.bodies;
        const double dt = w.parameters.time_step;
        // the ship's mass and the water's that moves along, as the step's start had them
        const Mat3 mass = b.ship.inverse_mass.inverse();
        Vec3 sum = mass * (b.velocity[kShip] - ship_before) - dt * w.ship.loads().total().force;
        double size = (mass * ship_before).norm() + dt * w.ship.loads().total().force.norm();
        for (std::size_t m = 0; m < b.moving.size(); ++m) {
            const auto i = static_cast<std::size_t>(b.moving[m]);
            sum += b.momentum[i] - before[i] - dt * w.loads[m].force;
            size += b.momentum[i].norm() + dt * w.loads[m].force.norm();
        }
        for (const Constraint& c : w.constraints) {
            const Vec3 j = c.total_normal() * c.normal + c.total_tangent();
            if (b.held[c.a]) sum -= j;
            if (b.held[c.b]) sum += j;
            size += j.norm();
        }
        REQUIRE(sum.norm() <= tolerance(1e-12) * size);
    }
}

TEST_CASE("the work of thrust and lines goes into motion, height, losses and ice",
          "[ship][energy]") {
    World w = hauled_ride(2e5, {surge, sway, heave, roll, pitch, yaw});
    while (w.time < 3.0 - 1e-6) step(w);
    const ShipEnergies& e = w.ship.energies();
    const double kinetic = w.ship.kinetic_energy(w.scene.bodies) - *e.kinetic_start;
    const double potential = w.ship.potential_energy(w.scene, w.parameters) - *e.potential_start;
    // what the ship gives is what the ice gets
    CHECK(e.ice == Near(w.ledger.ship_work).epsilon(1e-9));
    CHECK(e.ice > 100.0);
    CHECK(std::abs(e.thrust + e.tow + e.mooring) > 100.0);
    const double ship = e.residual(kinetic + potential);
    const double ice = w.ledger.residual(potential_energy(w.scene, w.parameters));
    CAPTURE(ship, ice, e.ice, e.thrust, e.tow, e.mooring, kinetic, potential, e.separation);
    // as much as a run may leave unexplained without a warning
    CHECK(std::abs(ship) < tolerance(0.005) * e.ice);
    CHECK(std::abs(ice) < tolerance(0.005) * e.ice);
}
