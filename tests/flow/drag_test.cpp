// SPDX-License-Identifier: GPL-3.0-or-later
// Drag in moving water: known answers, energy, bits.
//
// Tolerances: 1e-12 to 1e-9 are rounding of sums over triangles and their quarters; 0.5 % is the
// step's error, of first order.
#include <catch2/catch.hpp>
#include <random>

#include "solver/loads/load_floes.hpp"
#include "solver/record/energy_ledger.hpp"
#include "solver/water/relative_drag.hpp"
#include "tests/support/dice.hpp"
#include "tests/support/every_instruction_set.hpp"
#include "tests/support/make_meshes.hpp"
#include "tests/support/make_worlds.hpp"
#include "tests/support/same_bits.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;
using ice::test::tolerance;
using test::Dice;
using test::same_bits;

namespace {

Case water_case(double dt) {
    Case p = test::empty_space(dt);
    p.gravity = 9.81;
    p.drag_coefficient = 1.0;
    p.drag = DragModel::panel;
    p.buoyancy = BuoyancyModel::distributed;
    return p;
}

// A flow that varies from node to node, as large as the ship's speed.
FlowTable rough_table(bool symmetric) {
    FlowTable t;
    t.nodes = {12, 9, 6};
    t.spacing = 0.5;
    t.origin = Vec3(-3.0, symmetric ? 0.0 : -2.0, -2.5);
    t.symmetric = symmetric;
    std::mt19937 random(2);
    std::uniform_real_distribution<float> part(-1.0f, 1.0f);
    for (std::size_t k = 0; k < t.size(); ++k) {
        for (int axis = 0; axis < 3; ++axis) t.velocity.push_back(part(random));
        t.potential.push_back(part(random));
    }
    return t;
}

Quaternion turn(Dice& dice) {
    return Quaternion(dice.number(), dice.number(), dice.number(), dice.number()).normalized();
}

// Floes about a ship, some out of the table, some over the water, some under it.
World floes_in_flow(const Case& p, std::size_t count, std::size_t shapes, Dice& dice) {
    World w = test::plate_world(p, Vec3(1, 1, 1), 0.1, 0.2, 100.0);
    std::vector<std::int32_t> shape{
        test::add_shape(w, test::make_box_set(Vec3(1.0, 0.8, 0.3), 0.05, 0.1))};
    if (shapes > 1) {  // more corners than are kept
        SphereSet ball = test::make_ball_set(0.4);
        ball.mesh = test::make_globe(0.4, 7);
        shape.push_back(test::add_shape(w, ball));
    }
    Bodies& b = w.scene.bodies;
    for (std::size_t k = 0; k < count; ++k) {
        const Vec3 at(3.5 * dice.number(), 3.0 * dice.number(), 0.5 * dice.number() - 0.2);
        const std::size_t i =
            add_floe(w.scene, shape[k / 3 % shapes], 900.0, at, turn(dice), 0, false);
        if (k % 4 != 3) b.velocity[i] = dice.vector();
        if (k % 3 != 2) b.angular_velocity[i] = dice.vector();
    }
    return w;
}

}  // namespace

TEST_CASE(
    "drag in water at rest is that of the same motion, and in one that moves along it "
    "vanishes",
    "[flow][water][analytic]") {
    Dice dice{std::mt19937(4)};
    const Shape shape = build_shape(test::make_box_set(Vec3(1.0, 0.8, 0.3), 0.05, 0.1), true);
    for (int n = 0; n < 50; ++n) {
        const Mat3 rotation = turn(dice).toRotationMatrix();
        const Vec3 v = dice.vector(), w = dice.vector();
        const Motion motion{rotation, 0.3 * dice.number(), v, w};
        const RelativeDrag drag = relative_drag(
            shape, motion, [](const Vec3&) -> Vec3 { return Vec3::Zero(); }, 1.2, 1000.0);
        const WaterLoad still = panel_drag(shape, motion, 1.2, 1000.0);
        CHECK((drag.force - still.force).norm() < tolerance(1e-10) * (1.0 + still.force.norm()));
        CHECK((drag.moment - still.moment).norm() < tolerance(1e-10) * (1.0 + still.moment.norm()));
        CHECK(drag.loss == Near(-(still.force.dot(v) + still.moment.dot(w))).margin(1e-9));
        const auto water = [&](const Vec3& p) -> Vec3 {
            return rotation.transpose() * (v + w.cross(rotation * p));
        };
        const RelativeDrag none = relative_drag(shape, motion, water, 1.2, 1000.0);
        CHECK(none.force.norm() < tolerance(1e-9));
        CHECK(none.loss < tolerance(1e-9));
    }
}

TEST_CASE("drag in a linear flow is the sum over small patches", "[flow][water][analytic]") {
    Dice dice{std::mt19937(5)};
    const Shape shape = build_shape(test::make_box_set(Vec3(1.0, 0.8, 0.3), 0.05, 0.1), true);
    const Mat3 rotation = turn(dice).toRotationMatrix();
    const double height = 0.05;
    const Vec3 v = dice.vector(), w = dice.vector();
    Mat3 gradient;
    for (int k = 0; k < 9; ++k) gradient(k / 3, k % 3) = dice.number();
    const Motion motion{rotation, height, v, w};
    const auto water = [&](const Vec3& p) -> Vec3 { return gradient * p; };
    const RelativeDrag drag = relative_drag(shape, motion, water, 1.0, 1000.0);
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
    double loss = 0.0;
    const int n = 300;
    for (std::size_t t = 0; t < shape.mesh.triangles.size(); ++t)
        for (int i = 0; i < n; ++i)
            for (int j = 0; i + j < n; ++j)
                for (const double third : {1.0, 2.0}) {
                    if (third == 2.0 && i + j == n - 1) continue;
                    const double s = (i + third / 3.0) / n, r = (j + third / 3.0) / n;
                    const Vec3 a = shape.mesh.corner(t, 0);
                    const Vec3 p =
                        a + s * (shape.mesh.corner(t, 1) - a) + r * (shape.mesh.corner(t, 2) - a);
                    const Vec3 at = rotation * p;
                    if (at.z() + height > 0.0) continue;
                    const Vec3 u = v + w.cross(at) - rotation * (gradient * p);
                    const Vec3 area = rotation * shape.mesh.area_vector(t) / (n * n);
                    const Vec3 push = -500.0 * std::max(0.0, area.dot(u)) * u;
                    force += push;
                    moment += at.cross(push);
                    loss -= push.dot(u);
                }
    // patches that the water cuts count whole or not: an error of the order of 1 / n
    CHECK((drag.force - force).norm() < tolerance(2e-3) * force.norm());
    CHECK((drag.moment - moment).norm() < tolerance(4e-3) * moment.norm());
    CHECK(drag.loss == Near(loss).epsilon(2e-3));
}

TEST_CASE("every instruction set loads floes in moving water to the bits of the reference",
          "[flow][water][simd]") {
    Case p = water_case(GENERATE(0.01, 10.0));  // in the longer step drag stops most of them
    p.drag = GENERATE(DragModel::none, DragModel::projected, DragModel::panel);
    const bool symmetric = GENERATE(true, false);
    const std::size_t shapes = GENERATE(1u, 2u);
    Dice dice{std::mt19937(6)};
    for (std::size_t count = 1; count <= 18; ++count) {
        World w = floes_in_flow(p, count, shapes, dice);
        w.scene.dimension = count % 6 == 5 ? 2 : 3;
        w.scene.water.grid = FlowGrid(rough_table(symmetric));
        if (count % 4 == 1) w.scene.water.current = Vec3(0.3, -0.2, 0.0);
        w.scene.water.follow(Vec3(0.3, -0.1, 9.0), Vec3(0.7, 0.0, 0.0));
        const auto& floes = w.scene.bodies.moving;
        std::vector<FloeLoad> expected(floes.size());
        reference::load_floes(w.scene, p, floes, expected);
        test::on_every_instruction_set([&] {
            std::vector<FloeLoad> loads(floes.size());
            load_floes(w.scene, p, floes, loads);
            CHECK(same_bits(loads, expected));
        });
        for (std::size_t k = 0; k < floes.size() && w.scene.dimension == 3; ++k) {
            const auto i = static_cast<std::size_t>(floes[k]);
            const double own = expected[k].drag.force.dot(w.scene.bodies.velocity[i]) +
                               expected[k].drag.moment.dot(w.scene.bodies.angular_velocity[i]);
            // drag takes from the motion through the water, it never gives
            CHECK(expected[k].water_power - own >= -tolerance(1e-12) * std::abs(own));
        }
    }
}

TEST_CASE("a table of a ship at rest, and one out of reach, leave the bits of water at rest",
          "[flow][water]") {
    const Case p = water_case(0.01);
    Dice dice{std::mt19937(7)};
    World w = floes_in_flow(p, 17, 1, dice);
    std::vector<FloeLoad> still(17), loads(17);
    load_floes(w.scene, p, w.scene.bodies.moving, still);
    w.scene.water.grid = FlowGrid(rough_table(true));
    w.scene.water.follow(Vec3::Zero(), Vec3::Zero());
    load_floes(w.scene, p, w.scene.bodies.moving, loads);
    CHECK(same_bits(loads, still));
    w.scene.water.follow(Vec3(20.0, 0.0, 0.0), Vec3::UnitX());
    load_floes(w.scene, p, w.scene.bodies.moving, loads);
    CHECK(same_bits(loads, still));
    w.scene.water.follow(Vec3::Zero(), Vec3::UnitX());
    load_floes(w.scene, p, w.scene.bodies.moving, loads);
    CHECK_FALSE(same_bits(loads, still));
}

TEST_CASE("a current brings a floe to its speed as the book says, and its ledger balances",
          "[flow][water][analytic]") {
    Case p = water_case(0.01);
    p.gravity = 0.0;
    p.buoyancy = BuoyancyModel::none;
    World w = test::plate_world(p, Vec3(1, 1, 1), 0.1, 0.2, 100.0);
    const Vec3 size(1.0, 0.8, 0.3);
    const auto shape = test::add_shape(w, test::make_box_set(size, 0.05, 0.1));
    // wholly under water, where nothing turns it; the current along x meets its end
    const std::size_t floe =
        add_floe(w.scene, shape, 500.0, Vec3(0, 0, -3), Quaternion::Identity(), 0, false);
    const double speed = 0.5;
    w.scene.water.current = Vec3(speed, 0.0, 0.0);
    const double mass = 500.0 * size.prod(), area = size.y() * size.z();
    const double k = 1000.0 * area / (2.0 * mass);
    double least = 0.0;
    for (int n = 1; n <= 1000; ++n) {
        const double before = w.ledger.drag;
        step(w);
        least = std::min(least, w.ledger.drag - before);
        const double t = w.time;
        const double exact = speed * speed * k * t / (1.0 + speed * k * t);
        if (n % 100 == 0) CHECK(w.scene.bodies.velocity[floe].x() == Near(exact).epsilon(0.005));
    }
    CHECK(least >= 0.0);
    const EnergyLedger& ledger = w.ledger;
    CHECK(ledger.water_work > 0.0);
    const double gained = 0.5 * mass * w.scene.bodies.velocity[floe].squaredNorm();
    CHECK(ledger.water_work == Near(ledger.drag + gained).epsilon(1e-12));
}

TEST_CASE("a ship that moves and one that the ice and water drift past feel the same",
          "[flow][water]") {
    const double speed = 0.5;
    const auto run = [&](bool drifts) {
        Case p = water_case(0.01);
        p.speed_table = {{0.0, drifts ? 0.0 : speed}};
        // the hull's lower half is under water, floes before it
        World w = test::plate_world(p, Vec3(2.0, 2.0, 1.0), 0.1, 0.2, -0.5);
        w.scene.water.grid = FlowGrid(rough_table(true));
        const auto shape = test::add_shape(w, test::make_box_set(Vec3(0.6, 0.5, 0.2), 0.05, 0.1));
        const Vec3 drift(drifts ? -speed : 0.0, 0.0, 0.0);
        w.scene.water.current = drift;
        for (int k = 0; k < 4; ++k) {
            const std::size_t i =
                add_floe(w.scene, shape, 900.0, Vec3(1.4 + 0.7 * k, 0.1 * k, 0.01),
                         Quaternion::Identity(), 0, false);
            w.scene.bodies.momentum[i] = w.scene.bodies.mass[i] * drift;
            update_derived(w.scene.bodies, i);
        }
        std::vector<double> forces;
        for (int n = 0; n < 150; ++n) {
            step(w);
            const auto [normal, tangent] = test::ship_on_ice(w);
            forces.push_back(normal.x() + tangent.x());
        }
        return forces;
    };
    const auto moves = run(false), drifts = run(true);
    double largest = 0.0;
    for (const double f : moves) largest = std::max(largest, std::abs(f));
    REQUIRE(largest > 1.0);
    for (std::size_t n = 0; n < moves.size(); ++n)
        CHECK(drifts[n] == Near(moves[n]).margin(1e-9 * largest));
}
