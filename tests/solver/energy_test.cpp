// SPDX-License-Identifier: GPL-3.0-or-later
// The energy ledger against motions whose energies are known.
//
// Tolerances: 1e-12 and 1e-14 J are rounding of sums of energies of 1 to 100 J; 1e-6 is what 600
// stops of the solver at 1e-9 m/s leave of 0.5 m/s; 1e-9 J is rounding of a difference of energies
// of 1000 J, with a reserve.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "solver/integrate/rotation.hpp"
#include "solver/water/hydrostatics.hpp"
#include "tests/support/make_worlds.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;
using ice::test::tolerance;

namespace {

const double kMass = 900.0 * test::kPaperFloe.prod();

double residual(const World& w) {
    return w.ledger.residual(potential_energy(w.scene, w.parameters));
}

double potential_change(const World& w) {
    return potential_energy(w.scene, w.parameters) - *w.ledger.potential_start;
}

// A ball that flies at a plate from below with 0.7 m/s, seen by a ship that moves at `speed`.
World ball_under_plate(Case p, double speed) {
    p.speed_table = {{0.0, speed}};
    World w = test::plate_world(p, Vec3(2, 2, 0.4), 0.1, 0.1, 0.0);
    const auto ball = test::add_shape(w, test::make_ball_set(0.05));
    const std::size_t i =
        add_floe(w.scene, ball, 900.0, Vec3(0, 0, -0.2), Quaternion::Identity(), 0, false);
    w.scene.bodies.momentum[i] = w.scene.bodies.mass[i] * Vec3(speed, 0, 0.7);
    update_derived(w.scene.bodies, i);
    return w;
}

// A floe at rest just under a plate at 1 m depth.
World pressed_floe(const Case& p) {
    World w = test::plate_world(p, Vec3(20, 4, 0.4), 0.1, 0.1, -1.0);
    const auto box = test::add_shape(w, test::make_box_set(test::kPaperFloe, 0.05, 0.1));
    add_floe(w.scene, box, 900.0, Vec3(0, 0, -1.15), Quaternion::Identity(), 0, false);
    return w;
}

Case water(double dt) {
    Case p = test::empty_space(dt);
    p.gravity = 9.81;
    p.buoyancy = BuoyancyModel::distributed;
    return p;
}

// A floe far from the ship.
World free_floe(const Case& p, const Vec3& position, const Quaternion& orientation) {
    World w = test::plate_world(p, Vec3(1, 1, 1), 0.1, 0.2, 100.0);
    const auto box = test::add_shape(w, test::make_box_set(test::kPaperFloe, 0.05, 0.1));
    add_floe(w.scene, box, 900.0, position, orientation, 0, false);
    return w;
}

}  // namespace

TEST_CASE("weight and distributed buoyancy are the slope of the potential energy",
          "[energy][analytic]") {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    const Case p = water(0.01);
    for (int trial = 0; trial < 20; ++trial) {
        const Quaternion turned(any(random), any(random), any(random), any(random));
        World w = free_floe(p, Vec3(0, 0, 0.5 * any(random)), turned.normalized());
        const std::size_t i = 1;
        std::vector<FloeLoad> loads;
        measure_loads(w.scene, p, loads);
        const auto energy = [&](double rise, const Vec3& turn) {
            World other = w;
            other.scene.bodies.position[i].z() += rise;
            other.scene.bodies.orientation[i] =
                exponential_map(turn) * other.scene.bodies.orientation[i];
            update_derived(other.scene.bodies, i);
            return potential_energy(other.scene, p);
        };
        // central differences: error of order h^2 times stiffness over length, of 2300 N
        const double h = 1e-4;
        CHECK((energy(-h, Vec3::Zero()) - energy(h, Vec3::Zero())) / (2 * h) ==
              Near(loads[0].force.z()).margin(1e-2));
        for (int d = 0; d < 3; ++d)
            CHECK((energy(0, -h * Vec3::Unit(d)) - energy(0, h * Vec3::Unit(d))) / (2 * h) ==
                  Near(loads[0].moment[d]).margin(1e-2));
    }
}

TEST_CASE("an impact enters 1 - e^2 of its energy as restitution, for a ship at any speed",
          "[energy][analytic]") {
    const double e = GENERATE(0.0, 0.3, 1.0), speed = GENERATE(0.0, 2.0);
    Case p = test::empty_space(0.01);
    p.contact.restitution = e;
    World w = ball_under_plate(p, speed);
    for (int k = 0; k < 40; ++k) step(w);
    const double approach = 0.5 * w.scene.bodies.mass[1] * 0.7 * 0.7;
    // four corners share the impulse: the solver's tolerance
    CHECK(w.ledger.restitution == Near((1 - e * e) * approach).epsilon(1e-11).margin(1e-11));
    CHECK(w.ledger.kinetic_change == Near((e * e - 1) * approach).epsilon(1e-11).margin(1e-11));
    CHECK(w.ledger.ship_work == Near(0.0).margin(1e-12));  // pushed straight down
    CHECK(w.ledger.crushing == 0.0);
    CHECK(residual(w) == Near(0.0).margin(1e-12));
}

TEST_CASE("an impact that crushes enters its energy as crushing", "[energy][analytic]") {
    Case p = test::empty_space(0.01);
    p.contact.crushing_pressure = 8000.0;  // takes some steps to stop the ball
    World w = ball_under_plate(p, 0.0);
    const double before = kinetic_energy(w.scene.bodies);
    for (int k = 0; k < 100; ++k) step(w);
    CHECK(w.ledger.crushing > 0.8 * before);
    CHECK(w.ledger.crushing + w.ledger.restitution ==
          Near(before - kinetic_energy(w.scene.bodies)).epsilon(1e-12));
    CHECK(w.ledger.restitution >= 0.0);  // of the last step, which stops it
}

TEST_CASE("a ship that drags a floe up to its speed loses as much to friction as the floe gains",
          "[energy][analytic]") {
    Case p = water(0.01);
    p.buoyancy = GENERATE(BuoyancyModel::centre, BuoyancyModel::distributed);
    p.contact.friction_ship_ice = 0.1;
    p.speed_table = {{0.0, 0.5}};
    p.contact.tolerance = 1e-9;
    World w = pressed_floe(p);
    // 0.5 m/s at mu (rho_w - rho_i) / rho_i g takes 4.6 s
    for (int k = 0; k < 600; ++k) step(w);
    const double gained = 0.5 * kMass * 0.5 * 0.5;
    CHECK(w.ledger.kinetic_change == Near(gained).epsilon(1e-6));
    CHECK(w.ledger.friction == Near(gained).epsilon(1e-6));
    CHECK(w.ledger.ship_work == Near(2 * gained).epsilon(1e-6));
    CHECK(std::abs(w.ledger.restitution) < tolerance(1e-6) * gained);
    CHECK(std::abs(residual(w)) < tolerance(1e-6) * gained);
}

TEST_CASE("a floe at rest under the ship enters nothing", "[energy]") {
    Case p = water(0.01);
    p.contact.tolerance = 1e-12;
    World w = pressed_floe(p);
    step(w);  // the first contact stops what one step of buoyancy would have moved
    const EnergyLedger settled = w.ledger;
    for (int k = 0; k < 200; ++k) step(w);
    // 235 N held for 2 s: any speed of 1e-9 m/s would enter 5e-7 J
    CHECK(w.ledger.ship_work == settled.ship_work);
    CHECK(std::abs(w.ledger.restitution - settled.restitution) < tolerance(1e-7));
    CHECK(std::abs(w.ledger.friction - settled.friction) < tolerance(1e-7));
    CHECK(w.ledger.drag == 0.0);
}

TEST_CASE("a bobbing floe keeps its energy: the residual is bounded and of second order",
          "[energy][analytic]") {
    const auto worst = [](double dt) {
        World w = free_floe(water(dt), Vec3(0, 0, 0), Quaternion::Identity());
        const Bodies& b = w.scene.bodies;
        const double rest = floating_height(w.scene.shapes[1], Mat3::Identity(), 0.9);
        w.scene.bodies.position[1].z() = rest - 0.02;  // it stays partly submerged
        double largest = 0.0;
        for (int k = 0; k * dt < 20.0; ++k) {
            step(w);
            largest = std::max(largest, std::abs(residual(w)));
        }
        // about its equilibrium U = k z^2 / 2 with k = rho_w g A
        const double z = b.position[1].z() - rest;
        const double spring = 1000 * 9.81 * 0.8;
        World still = w;
        still.scene.bodies.position[1].z() = rest;
        CHECK(potential_energy(w.scene, w.parameters) -
                  potential_energy(still.scene, w.parameters) ==
              Near(0.5 * spring * z * z).margin(1e-9));
        return largest / (0.5 * spring * 0.02 * 0.02);
    };
    const double coarse = worst(0.01), fine = worst(0.005);
    // the velocities belong to half a step earlier than the poses: w dt / 2 = 0.03 of the energy
    // comes and goes, in step with the motion; it does not grow over 20 periods
    CHECK(coarse < tolerance(0.06));
    CHECK(fine < 0.6 * coarse);
}

TEST_CASE("what rises at its terminal speed loses its potential energy to drag",
          "[energy][analytic]") {
    Case p = water(0.01);
    p.drag = GENERATE(DragModel::projected, DragModel::panel);
    World w = free_floe(p, Vec3(0, 0, -20), Quaternion::Identity());
    for (int k = 0; k < 1500; ++k) step(w);
    const double lost = -potential_change(w);
    CHECK(lost > 2000.0);
    CHECK(w.ledger.drag + w.ledger.kinetic_change == Near(lost).epsilon(1e-3));
    CHECK(w.ledger.ship_work == 0.0);
}

TEST_CASE("buoyancy at the centre of gravity has no potential: the ledger says what is missing",
          "[energy]") {
    Case p = water(0.002);
    p.buoyancy = BuoyancyModel::centre;
    World w = free_floe(p, Vec3(0, 0, -0.1), Quaternion::Identity());
    Bodies& b = w.scene.bodies;
    b.angular_momentum[1] = b.inertia(1) * Vec3(0.3, 2.0, 0.1);
    update_derived(b, 1);
    for (int k = 0; k < 1000; ++k) step(w);  // more than half a turn
    const double exchanged = std::abs(w.ledger.buoyancy_moment);
    CHECK(exchanged > 5.0);
    CHECK(std::abs(residual(w)) < tolerance(0.02) * exchanged);
}

TEST_CASE("a ship among floes: what it gives is what motion, height and losses take",
          "[energy][property]") {
    Case p = water(0.005);
    p.drag = DragModel::panel;
    p.buoyancy = GENERATE(BuoyancyModel::distributed, BuoyancyModel::centre);
    p.contact.crushing_pressure = GENERATE(INFINITY, 2e4);
    p.contact.restitution = 0.3;
    p.contact.friction_ship_ice = 0.1;
    p.contact.friction_ice_ice = 0.3;
    p.contact.iterations = 50;
    p.contact.tolerance = 1e-5;
    p.speed_table = {{0.0, 0.0}, {1.0, 1.0}};  // it starts from rest
    World w = test::plate_world(p, Vec3(2, 2, 1.0), 0.1, 0.1, -0.6);
    const auto box = test::add_shape(w, test::make_box_set(test::kPaperFloe, 0.05, 0.1));
    for (int row = 0; row < 4; ++row)
        for (int k = -1; k <= 1; ++k)
            add_floe(w.scene, box, 900.0, Vec3(1.6 + 1.05 * row, 0.85 * k, -0.12),
                     Quaternion::Identity(), 0, false);
    for (int k = 0; k < 1000; ++k) step(w);
    CAPTURE(w.ledger.ship_work, w.ledger.friction, w.ledger.restitution, w.ledger.crushing,
            w.ledger.drag, w.ledger.kinetic_change, potential_change(w), w.ledger.separation);
    REQUIRE(w.ledger.ship_work > 100.0);
    CHECK(w.ledger.friction > 0.0);
    CHECK(w.ledger.restitution > 0.0);
    CHECK(w.ledger.crushing >= 0.0);
    CHECK(w.ledger.drag > 0.0);
    // twenty times the largest seen here; the paper's cases ask for 5e-3
    CHECK(std::abs(residual(w)) < tolerance(1e-4) * w.ledger.ship_work);
}

TEST_CASE("more than 0.5 % of unexplained work is worth a warning, less is not", "[energy]") {
    EnergyLedger ledger;
    ledger.potential_start = 50.0;
    ledger.ship_work = 1000.0;
    ledger.friction = 700.0;
    ledger.drag = 194.0;
    ledger.kinetic_change = 2.0;
    Summary good, bad, drifting, idle;
    fill_energy(ledger, 150.0, good);  // 100 J of potential energy gained
    CHECK(good.energy.at("potential_J") == Near(100.0));
    CHECK(good.energy.at("residual_J") == Near(4.0));
    CHECK(good.energy.at("residual_share") == Near(0.004));
    CHECK(good.warnings.empty());

    fill_energy(ledger, 148.0, bad);
    REQUIRE(bad.warnings.size() == 1);
    CHECK_THAT(bad.warnings[0].text, Catch::Contains("0.6 % of the ship's work"));

    CHECK(good.energy.count("drift_work_J") == 0);  // nothing drifts

    ledger.drift_work = -250.0;  // of the sum of both works the residual is 254 J more
    fill_energy(ledger, 150.0, drifting);
    CHECK(drifting.energy.at("drift_work_J") == -250.0);
    CHECK(drifting.energy.at("residual_share") == Near((4.0 - 250.0) / 1250.0));

    fill_energy({}, 0.0, idle);  // a ship that met no ice
    CHECK(idle.warnings.empty());
    CHECK(idle.energy.at("residual_share") == 0.0);
}

TEST_CASE("ice that is held does not spin at the start of a step, whatever it did before",
          "[energy][level_ice]") {
    World w = test::plate_world(test::empty_space(0.01), Vec3(4, 2, 0.6), 0.1, 0.2, 0.0);
    const auto shape = test::add_shape(w, test::make_box_set(Vec3(1, 1, 0.5), 0.05, 0.1));
    const std::size_t floe =
        add_floe(w.scene, shape, 900.0, Vec3(9, 0, 0), Quaternion::Identity(), 0, false);
    Bodies& b = w.scene.bodies;
    b.angular_velocity[floe] = Vec3(0, 2, 0);
    StepStart start;
    start.take(b);
    REQUIRE(start.angular_velocity[floe].y() == 2.0);
    // a slot of level ice whose piece is gone holds a part of the edge
    b.held[floe] = 1;
    list_moving(b);
    update_derived(b, floe);
    start.take(b);
    CHECK(start.angular_velocity[floe].isZero(0.0));
}

TEST_CASE("held ice that drifts works on its neighbour by push and friction, on either side",
          "[energy][analytic]") {
    World w = test::plate_world(test::empty_space(0.01), Vec3(4, 2, 0.6), 0.1, 0.2, 0.0);
    const auto shape = test::add_shape(w, test::make_box_set(Vec3(1, 1, 0.5), 0.05, 0.1));
    // a loose floe and a held one that drifts at (0.3, -0.2) m/s
    for (const bool held : {false, true})
        add_floe(w.scene, shape, 900.0, Vec3(9.0 + (held ? 1.0 : 0.0), 0, 0),
                 Quaternion::Identity(), 0, held);
    Bodies& b = w.scene.bodies;
    b.momentum[2] = b.mass[2] * Vec3(0.3, -0.2, 0.0);
    update_derived(b, 2);
    StepStart start;
    start.take(b);
    PositionCorrections none;
    none.shift.assign(b.size(), Vec3::Zero());
    none.turn = none.shift;
    Constraint c{};
    c.normal = Vec3::UnitX();
    c.arm_a = c.arm_b = Vec3::Zero();
    c.max_impulse = INFINITY;
    c.rest_normal = 5.0;
    c.rest_tangent = Vec3(0, 2.0, 0);
    // impulses (5, 2) on the floe of the larger number, their opposite on the other: the held floe
    // gives (-5, -2) where it is b, (5, 2) where it is a
    for (const bool held_is_a : {false, true}) {
        c.a = held_is_a ? 2 : 1;
        c.b = held_is_a ? 1 : 2;
        EnergyLedger ledger;
        enter_step(w.scene, w.parameters, {c}, std::vector<FloeLoad>(b.moving.size()), none, start,
                   ledger);
        CHECK(ledger.drift_work == Near((held_is_a ? 1.0 : -1.0) * (5.0 * 0.3 - 2.0 * 0.2)));
    }
}
