// SPDX-License-Identifier: GPL-3.0-or-later
// The flow's dynamic pressure on floes: closed forms, a book's flow, energy, bits.
//
// Tolerances: 1e-9 is rounding of the pressure at 10 m, as buoyancy of 0.24 m3; 1e-12 is rounding
// of sums over triangles.
#include <catch2/catch.hpp>
#include <cstring>
#include <numbers>

#include "solver/loads/load_floes.hpp"
#include "solver/record/energy_ledger.hpp"
#include "solver/water/hydrostatics.hpp"
#include "solver/water/pressure_load.hpp"
#include "tests/support/dice.hpp"
#include "tests/support/every_instruction_set.hpp"
#include "tests/support/make_meshes.hpp"
#include "tests/support/make_worlds.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;
using ice::test::tolerance;
using test::Dice;

namespace {

Shape box_shape() { return build_shape(test::make_box_set(Vec3(1.0, 0.8, 0.3), 0.05, 0.1), true); }

Quaternion turn(Dice& dice) {
    return Quaternion(dice.number(), dice.number(), dice.number(), dice.number()).normalized();
}

// Of a sphere of radius 1 at 1 m/s along +x: phi = -x / (2 r^3).
Vec3 sphere_velocity(const Vec3& p) {
    const double r = p.norm();
    return -0.5 / (r * r * r) * (Vec3::UnitX() - 3.0 * p.x() / (r * r) * p);
}

// A table whose velocity grows along all axes: linear between its nodes, so exact.
FlowTable even_table(const Mat3& gradient) {
    FlowTable t;
    t.nodes = {21, 21, 11};
    t.spacing = 0.5;
    t.origin = Vec3(-5.0, -5.0, -5.0);
    for (int k = 0; k < 11; ++k)
        for (int j = 0; j < 21; ++j)
            for (int i = 0; i < 21; ++i) {
                const Vec3 w = gradient * (t.origin + t.spacing * Vec3(i, j, k));
                for (int axis = 0; axis < 3; ++axis)
                    t.velocity.push_back(static_cast<float>(w[axis]));
                t.potential.push_back(0.0f);
            }
    return t;
}

Case deep_case() {
    Case p = test::empty_space(0.01);
    p.gravity = 0.0;
    p.buoyancy = BuoyancyModel::none;
    p.drag = DragModel::none;
    p.water_density = 1000.0;
    return p;
}

}  // namespace

TEST_CASE("a pressure that is linear in place pushes a sunken floe by its volume times the slope",
          "[flow][water][analytic]") {
    Dice dice{std::mt19937(11)};
    const Shape shape = box_shape();
    const double volume = 1.0 * 0.8 * 0.3;
    for (int n = 0; n < 30; ++n) {
        const Mat3 rotation = turn(dice).toRotationMatrix();
        const Vec3 slope = 1e3 * dice.vector();
        const double level = 1e4 * dice.number();
        const WaterLoad load = pressure_load(shape, rotation, -5.0,
                                             [&](const Vec3& at) { return level + slope.dot(at); });
        const Vec3 expected = -volume * (rotation * slope);
        // sums of forces of level times area, 2.7 m2
        CHECK((load.force - expected).norm() <
              tolerance(1e-12) * (2.7 * std::abs(level) + slope.norm()));
        CHECK(load.moment.norm() < tolerance(1e-12) * (2.7 * std::abs(level) + slope.norm()));
    }
}

TEST_CASE("water at rest presses like buoyancy, on floes of which part is dry too",
          "[flow][water][analytic]") {
    Dice dice{std::mt19937(12)};
    const Shape shape = box_shape();
    for (int n = 0; n < 30; ++n) {
        const Mat3 rotation = turn(dice).toRotationMatrix();
        const double height = 0.3 * dice.number();
        const auto depth = [&](const Vec3& at) {
            return -9810.0 * (rotation.row(2).dot(at) + height);
        };
        const WaterLoad load = pressure_load(shape, rotation, height, depth);
        const Submerged wet = measure_submerged(shape, rotation, height);
        const Vec3 lift(0.0, 0.0, 9810.0 * wet.volume);
        CHECK((load.force - lift).norm() < tolerance(1e-9) * 9810.0 * 0.24);
        CHECK((load.moment - wet.centre.cross(lift)).norm() < tolerance(1e-9) * 9810.0 * 0.24);
    }
}

TEST_CASE(
    "a small ball in the flow of a sphere feels its mass of water times that water's "
    "acceleration",
    "[flow][water][analytic]") {
    // in the ship's frame the water has u = w - e_x, and Dw/Dt = (u . grad) w
    SphereSet ball = test::make_ball_set(0.02);
    ball.mesh = test::make_globe(0.02, 8);
    ball.solid = measure_mass(ball.mesh);
    const Shape shape = build_shape(ball, true);
    const double density = 1000.0;
    for (const Vec3& place : {Vec3(1.2, 0.3, -0.4), Vec3(0.2, -1.3, -0.6), Vec3(-1.1, 0.5, -0.9)}) {
        const auto pressure = [&](const Vec3& at) {
            const Vec3 w = sphere_velocity(place + at);
            return density * (w.x() - 0.5 * w.squaredNorm());
        };
        const WaterLoad load = pressure_load(shape, Mat3::Identity(), place.z(), pressure);
        const Vec3 u = sphere_velocity(place) - Vec3::UnitX();
        const double step = 1e-5;
        const Vec3 rate =
            (sphere_velocity(place + step * u) - sphere_velocity(place - step * u)) / (2.0 * step);
        const Vec3 expected = density * measure_mass(ball.mesh).volume * rate;
        CHECK((load.force - expected).norm() < tolerance(0.01) * expected.norm());
    }
}

TEST_CASE("the table's pressure pushes a floe: U squared, nothing far off or when it is off",
          "[flow][water][analytic]") {
    Case p = deep_case();
    World w = test::plate_world(p, Vec3(1, 1, 1), 0.1, 0.2, 100.0);
    const auto shape = test::add_shape(w, test::make_box_set(Vec3(0.1, 0.08, 0.06), 0.01, 0.02));
    const Vec3 place(1.0, 0.4, -2.0);
    const std::size_t floe =
        add_floe(w.scene, shape, 900.0, place, Quaternion::Identity(), 0, false);
    Mat3 gradient;
    gradient << 0.05, 0.02, 0.0, 0.02, -0.03, 0.01, 0.0, 0.01, -0.02;
    w.scene.water.grid = FlowGrid(even_table(gradient));
    const double speed = 2.0;
    w.scene.water.follow(Vec3::Zero(), Vec3(speed, 0.0, 0.0));
    CHECK(flow_pressure(w.scene, p, floe).force.norm() == 0.0);
    w.scene.water.presses = true;
    const WaterLoad load = flow_pressure(w.scene, p, floe);
    // grad (g_x - |g|^2 / 2) = G^T (e_x - g)
    const Vec3 g = gradient * place;
    const Vec3 slope = 1000.0 * speed * speed * gradient.transpose() * (Vec3::UnitX() - g);
    const Vec3 expected = -0.1 * 0.08 * 0.06 * slope;
    // the second derivative over 0.05 m, and velocities stored as floats
    CHECK((load.force - expected).norm() < tolerance(1e-3) * expected.norm());
    w.scene.water.follow(Vec3::Zero(), Vec3(2.0 * speed, 0.0, 0.0));
    CHECK(flow_pressure(w.scene, p, floe).force.isApprox(4.0 * load.force, tolerance(1e-12)));
    w.scene.water.follow(Vec3(20.0, 0.0, 0.0), Vec3(speed, 0.0, 0.0));
    CHECK(flow_pressure(w.scene, p, floe).force.norm() == 0.0);
    // a current that runs with the ship leaves it without flow
    w.scene.water.current = Vec3(speed, 0.0, 0.0);
    w.scene.water.follow(Vec3::Zero(), Vec3(speed, 0.0, 0.0));
    CHECK(flow_pressure(w.scene, p, floe).force.norm() == 0.0);
}

TEST_CASE("what the pressure gives a floe is entered as the water's work",
          "[flow][water][energy]") {
    Case p = deep_case();
    p.speed_table = {{0.0, 1.0}};
    World w = test::plate_world(p, Vec3(1, 1, 1), 0.1, 0.2, 100.0);
    const auto shape = test::add_shape(w, test::make_box_set(Vec3(1.0, 0.8, 0.3), 0.05, 0.1));
    const std::size_t floe =
        add_floe(w.scene, shape, 900.0, Vec3(2.0, 0.4, -2.0), Quaternion::Identity(), 0, false);
    Mat3 gradient;
    gradient << 0.1, 0.02, 0.0, 0.02, -0.06, 0.01, 0.0, 0.01, -0.04;
    w.scene.water.grid = FlowGrid(even_table(gradient));
    w.scene.water.presses = true;
    for (int n = 0; n < 200; ++n) step(w);
    const Bodies& b = w.scene.bodies;
    const double kinetic = 0.5 * b.momentum[floe].dot(b.velocity[floe]) +
                           0.5 * b.angular_momentum[floe].dot(b.angular_velocity[floe]);
    CHECK(kinetic > 0.0);
    CHECK(w.ledger.drag == 0.0);
    // velocities are linear in loads; angular ones but for the turn of the axes within a step
    CHECK(w.ledger.water_work == Near(kinetic).epsilon(1e-3));
}

TEST_CASE("every instruction set gives loads with pressure to the bits of the reference",
          "[flow][simd]") {
    Case p = test::empty_space(0.01);
    p.gravity = 9.81;
    p.drag = DragModel::panel;
    p.dimension = 3;
    Dice dice{std::mt19937(13)};
    World w = test::plate_world(p, Vec3(1, 1, 1), 0.1, 0.2, 100.0);
    const auto shape = test::add_shape(w, test::make_box_set(Vec3(1.0, 0.8, 0.3), 0.05, 0.1));
    for (int k = 0; k < 19; ++k) {
        const Vec3 at(4.0 * dice.number(), 4.0 * dice.number(), 0.5 * dice.number() - 0.2);
        const std::size_t i = add_floe(w.scene, shape, 900.0, at, turn(dice), 0, false);
        w.scene.bodies.velocity[i] = dice.vector();
    }
    Mat3 gradient;
    for (int k = 0; k < 9; ++k) gradient(k / 3, k % 3) = 0.1 * dice.number();
    w.scene.water.grid = FlowGrid(even_table(gradient));
    w.scene.water.presses = true;
    w.scene.water.follow(Vec3::Zero(), Vec3(1.5, 0.0, 0.0));
    const auto& floes = w.scene.bodies.moving;
    std::vector<FloeLoad> expected(floes.size());
    reference::load_floes(w.scene, p, floes, expected);
    bool pressed = false;
    for (const FloeLoad& load : expected) pressed = pressed || load.pressure.force.norm() > 0.0;
    CHECK(pressed);
    test::on_every_instruction_set([&] {
        std::vector<FloeLoad> loads(floes.size());
        load_floes(w.scene, p, floes, loads);
        CHECK(std::memcmp(static_cast<const void*>(loads.data()), expected.data(),
                          loads.size() * sizeof(FloeLoad)) == 0);
    });
}
