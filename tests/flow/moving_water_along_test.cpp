// SPDX-License-Identifier: GPL-3.0-or-later
// Floes that move water along: inertia, impacts, Kirchhoff's equations, energy ledger, bits.
//
// Tolerances: 1 % and 0.5 % are the step's error, of first order; 1e-12 and 1e-11 are rounding of
// momenta over the steps.
#include <catch2/catch.hpp>
#include <cmath>

#include "common/geometry/mass_properties.hpp"
#include "solver/loads/potential_energy.hpp"
#include "solver/record/recorder.hpp"
#include "solver/run/measure_imbalance.hpp"
#include "solver/scene/set_added_mass.hpp"
#include "tests/support/every_instruction_set.hpp"
#include "tests/support/make_prisms.hpp"
#include "tests/support/make_worlds.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;
using ice::test::tolerance;

namespace {

const Vec3 kBox(1.0, 0.8, 0.3);

Case deep_case(double dt) {
    Case p = test::empty_space(dt);
    p.water_density = 1000.0;
    p.floes_move_water = true;
    return p;
}

// A hull far away; add floes to it.
World far_world(const Case& p) { return test::plate_world(p, Vec3(1, 1, 1), 0.1, 0.2, 1000.0); }

std::size_t add_box(World& w, std::int32_t shape, const Vec3& at,
                    const Quaternion& turn = Quaternion::Identity()) {
    return add_floe(w.scene, shape, 900.0, at, turn, 0, false);
}

// The whole mass matrix of a floe along a direction, or about it.
double mass_along(const Bodies& b, std::size_t i, int axis) {
    return b.mass[i] + b.inertia_row_of(i).added(axis, axis);
}

void set_motion(Bodies& b, std::size_t i, const Vec3& v, const Vec3& spin) {
    const Mat3& r = b.rotation[i];
    b.momentum[i] = b.mass[i] * v + r * b.inertia_row_of(i).added * r.transpose() * v;
    b.angular_momentum[i] = r * b.inertia(i) * r.transpose() * spin;
    update_derived(b, i);
}

// Kirchhoff's equations in body axes by Runge-Kutta's method in fine steps: p' = p x w,
// l' = l x w + p x v, with p = M v, l = I w; returns v and w in body axes at the end.
std::pair<Vec3, Vec3> kirchhoff(const Mat3& mass, const Mat3& inertia, Vec3 v, Vec3 w,
                                double time) {
    using State = std::pair<Vec3, Vec3>;  // p, l
    const Mat3 inverse_mass = mass.inverse(), inverse_inertia = inertia.inverse();
    const auto slope = [&](const State& s) -> State {
        const Vec3 speed = inverse_mass * s.first, spin = inverse_inertia * s.second;
        return {s.first.cross(spin), s.second.cross(spin) + s.first.cross(speed)};
    };
    const auto step = [](const State& s, const State& k, double h) -> State {
        return {s.first + h * k.first, s.second + h * k.second};
    };
    State s{mass * v, inertia * w};
    const int steps = 20000;
    const double h = time / steps;
    for (int n = 0; n < steps; ++n) {
        const State k1 = slope(s), k2 = slope(step(s, k1, 0.5 * h)),
                    k3 = slope(step(s, k2, 0.5 * h)), k4 = slope(step(s, k3, h));
        s.first += h / 6.0 * (k1.first + 2.0 * k2.first + 2.0 * k3.first + k4.first);
        s.second += h / 6.0 * (k1.second + 2.0 * k2.second + 2.0 * k3.second + k4.second);
    }
    return {inverse_mass * s.first, inverse_inertia * s.second};
}

}  // namespace

TEST_CASE("a force gives a floe and its water the speed of both masses together",
          "[flow][added-mass][analytic]") {
    World w = far_world(deep_case(0.01));
    const auto shape = test::add_shape(w, test::make_box_set(kBox, 0.05, 0.1));
    const std::size_t floe = add_box(w, shape, Vec3(0, 0, -50));
    set_added_mass(w.scene, w.parameters);
    const Bodies& b = w.scene.bodies;
    // a plate pushed broadside moves more water than it weighs, edge-on less than half
    CHECK(mass_along(b, floe, 2) > 2.5 * b.mass[floe]);
    CHECK(mass_along(b, floe, 0) < 1.5 * b.mass[floe]);
    for (int axis = 0; axis < 3; ++axis) {
        World one = w;
        one.applied_loads.resize(2);
        one.applied_loads[floe].force = 100.0 * Vec3::Unit(axis);
        const double share = 1.0 / mass_along(b, floe, axis);
        step(one);
        // the panels of the two halves of a face are not mirror images: 1e-3 of A is off-diagonal
        CHECK(one.scene.bodies.velocity[floe][axis] == Near(1.0 * share).epsilon(1e-3));
        // exactly: all of the impulse is in the momentum
        CHECK((one.scene.bodies.momentum[floe] - Vec3::Unit(axis)).norm() < tolerance(1e-12));
    }
}

TEST_CASE("floes that meet part by the masses that they and their water have",
          "[flow][added-mass][analytic]") {
    const double e = GENERATE(0.0, 0.5);
    Case p = deep_case(0.001);
    p.contact.restitution = e;
    p.contact.friction_ice_ice = 0.0;
    World w = far_world(p);
    const auto large = test::add_shape(w, test::make_box_set(kBox, 0.05, 0.1));
    const auto small = test::add_shape(w, test::make_box_set(Vec3(0.6, 0.6, 0.3), 0.05, 0.1));
    const std::size_t below = add_box(w, large, Vec3(0, 0, -50));
    const std::size_t above = add_box(w, small, Vec3(0, 0, -50 + 0.3 + 1e-4));
    set_added_mass(w.scene, w.parameters);
    Bodies& b = w.scene.bodies;
    for (const std::size_t i : {below, above}) {  // along the axes, so that nothing turns
        Inertia& inertia = b.inertias[static_cast<std::size_t>(b.inertia_row[i])];
        inertia.added = Mat3(inertia.added.diagonal().asDiagonal());
        inertia.inverse_excess = Mat3((Vec3::Constant(b.mass[i]) + inertia.added.diagonal())
                                          .cwiseInverse()
                                          .asDiagonal()) -
                                 Mat3::Identity() / b.mass[i];
    }
    set_motion(b, below, Vec3(0, 0, 1.0), Vec3::Zero());
    set_motion(b, above, Vec3::Zero(), Vec3::Zero());
    const double m1 = mass_along(b, below, 2), m2 = mass_along(b, above, 2);
    step(w);
    CHECK(b.velocity[below].z() == Near((m1 - e * m2) / (m1 + m2)).epsilon(1e-6));
    CHECK(b.velocity[above].z() == Near(m1 * (1.0 + e) / (m1 + m2)).epsilon(1e-6));
    CHECK((b.momentum[below] + b.momentum[above] - m1 * Vec3::UnitZ()).norm() <
          tolerance(1e-12) * m1);
}

TEST_CASE("a floe free in water at rest moves by Kirchhoff's equations",
          "[flow][added-mass][analytic]") {
    const double time = 2.0;
    const Vec3 v(0.3, 0.1, 0.2), spin(0.3, 0.6, -0.2);
    const auto run = [&](double dt) {
        World w = far_world(deep_case(dt));
        const auto shape = test::add_shape(w, test::make_box_set(kBox, 0.05, 0.1));
        const std::size_t i = add_box(w, shape, Vec3(0, 0, -50));
        set_added_mass(w.scene, w.parameters);
        Bodies& b = w.scene.bodies;
        set_motion(b, i, v, spin);
        const Vec3 momentum = b.momentum[i];
        const double energy = kinetic_energy(b);
        while (w.time < time - 0.5 * dt) {
            const Momenta before = momenta_of(w);
            step(w);
            require_balance(before, w);
        }
        CHECK((b.momentum[i] - momentum).norm() < tolerance(1e-11) * momentum.norm());
        const Inertia& inertia = b.inertia_row_of(i);
        const auto [exact_v, exact_spin] =
            kirchhoff(b.mass[i] * Mat3::Identity() + inertia.added, inertia.body, v, spin, time);
        const Mat3 back = b.rotation[i].transpose();
        const Vec3 off(kinetic_energy(b) / energy - 1.0, (back * b.velocity[i] - exact_v).norm(),
                       (back * b.angular_velocity[i] - exact_spin).norm());
        return off;
    };
    const Vec3 coarse = run(0.01), fine = run(0.005);
    CAPTURE(coarse.transpose(), fine.transpose());
    // explicit moments: of first order, 1 % at the step of the cases
    CHECK(coarse.tail<2>().norm() < tolerance(0.01));
    CHECK(fine.tail<2>().norm() < 0.6 * coarse.tail<2>().norm());
    CHECK(std::abs(coarse[0]) < tolerance(0.01));
    CHECK(std::abs(fine[0]) < 0.6 * std::abs(coarse[0]));
}

TEST_CASE("a floe in an even current moves as in water at rest, seen by the current",
          "[flow][added-mass]") {
    const Vec3 current(0.5, 0.2, 0.0), v(0.1, 0.0, 0.2), spin(0.2, 0.4, 0.1);
    const auto velocity_after = [&](bool flows, double dt) {
        World w = far_world(deep_case(dt));
        const auto shape = test::add_shape(w, test::make_box_set(kBox, 0.05, 0.1));
        const std::size_t i = add_box(w, shape, Vec3(0, 0, -50));
        set_added_mass(w.scene, w.parameters);
        if (flows) w.scene.water.current = current;
        set_motion(w.scene.bodies, i, v + (flows ? current : Vec3(Vec3::Zero())), spin);
        while (w.time < 1.0 - 0.5 * dt) step(w);
        return Vec3(w.scene.bodies.velocity[i] - (flows ? current : Vec3(Vec3::Zero())));
    };
    const auto off = [&](double dt) {
        return (velocity_after(true, dt) - velocity_after(false, dt)).norm();
    };
    const double coarse = off(0.01), fine = off(0.005);
    CAPTURE(coarse, fine);
    CHECK(coarse < tolerance(0.01) * v.norm());
    CHECK(fine < 0.6 * coarse);
}

TEST_CASE("a current brings a floe and its water to its speed as the book says",
          "[flow][added-mass][analytic]") {
    Case p = deep_case(0.01);
    p.drag = DragModel::panel;
    World w = far_world(p);
    const auto shape = test::add_shape(w, test::make_box_set(kBox, 0.05, 0.1));
    const std::size_t floe =
        add_floe(w.scene, shape, 500.0, Vec3(0, 0, -50), Quaternion::Identity(), 0, false);
    set_added_mass(w.scene, p);
    // v = W^2 k t / (1 + W k t), k = rho C_d A / (2 (m + A_11))
    const double speed = 0.5;
    w.scene.water.current = Vec3(speed, 0.0, 0.0);
    const double k = 1000.0 * kBox.y() * kBox.z() / (2.0 * mass_along(w.scene.bodies, floe, 0));
    for (int n = 1; n <= 500; ++n) {
        step(w);
        const double exact = speed * speed * k * w.time / (1.0 + speed * k * w.time);
        if (n % 100 == 0) CHECK(w.scene.bodies.velocity[floe].x() == Near(exact).epsilon(0.005));
    }
}

TEST_CASE(
    "floes with their water, pressed under a plate that moves, balance and close their ledger",
    "[flow][added-mass][balance][energy]") {
    Case p = deep_case(0.005);
    p.gravity = 9.81;
    p.buoyancy = BuoyancyModel::distributed;
    p.drag = DragModel::panel;
    p.speed_table = {{0.0, 1.0}};
    p.contact.iterations = 60;
    p.contact.tolerance = 1e-4;
    const auto make = [&] {
        World w = test::plate_world(p, Vec3(8, 4, 0.4), 0.1, 0.2, -1.0);
        const auto box = test::add_shape(w, test::make_box_set(kBox, 0.05, 0.1));
        for (const double z : {-1.16, -1.47})
            add_box(w, box, Vec3(0, 0, z), Quaternion(Eigen::AngleAxisd(0.1 * z, Vec3::UnitX())));
        set_added_mass(w.scene, p);
        return w;
    };
    World w = make();
    for (int n = 0; n < 400; ++n) {
        const Momenta before = momenta_of(w);
        step(w);
        REQUIRE_NOTHROW(require_balance(before, w));
    }
    const double work = w.ledger.ship_work;
    CHECK(work > 0.0);
    CHECK(std::abs(w.ledger.residual(potential_energy(w.scene, p))) < tolerance(0.005) * work);
    const std::uint64_t expected = state_hash(w.scene, w.constraints);
    test::on_every_instruction_set([&] {
        World again = make();
        for (int n = 0; n < 400; ++n) step(again);
        CHECK(state_hash(again.scene, again.constraints) == expected);
    });
}

TEST_CASE("what couples shifts and turns of plates about their centre of mass is small",
          "[flow][added-mass]") {
    test::Dice dice{std::mt19937(3)};
    double most = 0.0;
    for (int k = 0; k < 6; ++k) {
        // a plate of uneven outline, five times as broad as thick
        std::vector<Vec3> low, high;
        const int sides = 4 + k % 3;
        for (int c = 0; c < sides; ++c) {
            const double angle = 2.0 * 3.14159265358979 * (c + 0.35 * dice.number()) / sides;
            low.emplace_back(0.8 * std::cos(angle), 0.6 * std::sin(angle), -0.15);
            high.emplace_back(low.back().x(), low.back().y(), 0.15);
        }
        TriangleMesh mesh = test::make_ring_mesh(low, high);
        const MassProperties solid = measure_mass(mesh);
        for (Vec3& v : mesh.vertices) v -= solid.centroid;
        const Mat6 a = added_mass_of_shape(mesh, 1000.0);
        const double mass = 900.0 * solid.volume;
        const Mat3 inertia = 900.0 * solid.inertia;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                most = std::max(
                    most, std::abs(a(i, 3 + j)) /
                              std::sqrt((mass + a(i, i)) * (inertia(j, j) + a(3 + j, 3 + j))));
    }
    CAPTURE(most);
    CHECK(most < 0.05);
}
