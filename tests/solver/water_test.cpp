// SPDX-License-Identifier: GPL-3.0-or-later
// Buoyancy and drag against hydrostatics and terminal speeds.
//
// Tolerances: 1e-15 to 1e-12 are rounding of sums over the box's twelve triangles; 1e-11 is a
// height bisected to 1e-12 of itself; 1 % is the tilt squared over GM.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "solver/water/drag.hpp"
#include "solver/water/hydrostatics.hpp"
#include "tests/support/make_worlds.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;
using ice::test::tolerance;

namespace {

Shape paper_floe() { return build_shape(test::make_box_set(Vec3(1, 0.8, 0.3), 0.05, 0.1), true); }

World floating_world(double dt, BuoyancyModel buoyancy, DragModel drag) {
    Case p = test::empty_space(dt);
    p.gravity = 9.81;
    p.buoyancy = buoyancy;
    p.drag = drag;
    World w = test::plate_world(p, Vec3(1, 1, 1), 0.1, 0.2, 100.0);
    w.scene.shapes.push_back(paper_floe());
    return w;
}

}  // namespace

TEST_CASE("an upright box is submerged by its draught, with the centre half way",
          "[water][analytic]") {
    const Shape shape = paper_floe();
    const double height = GENERATE(-0.2, -0.15, -0.12, 0.0, 0.1, 0.15);
    const Submerged s = measure_submerged(shape, Mat3::Identity(), height);
    const double draught = std::clamp(0.15 - height, 0.0, 0.3);
    CHECK(s.volume == Near(0.8 * draught).margin(1e-15));
    if (draught > 0.0) CHECK(s.centre.z() == Near(-0.15 + 0.5 * draught).margin(1e-14));
    CHECK(s.centre.head<2>().norm() < tolerance(1e-14));
}

TEST_CASE("a box turned on its corner is half submerged at its centre", "[water][analytic]") {
    const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    const Submerged s = measure_submerged(paper_floe(), turn, 0.0);
    CHECK(s.volume == Near(0.12).epsilon(1e-13));
}

TEST_CASE("the submerged volume has no steps when corners cross the surface", "[water][property]") {
    const Shape shape = paper_floe();
    const Mat3 turn = Eigen::AngleAxisd(0.4, Vec3(2, 1, 0).normalized()).toRotationMatrix();
    double last = measure_submerged(shape, turn, 0.6).volume;
    for (double height = 0.6; height > -0.6; height -= 1e-4) {
        const double now = measure_submerged(shape, turn, height).volume;
        REQUIRE(now >= last - tolerance(1e-14));
        REQUIRE(now - last < 1e-4 * 1.3);  // at most the largest section, 1.3 m2 with the tilt
        last = now;
    }
    CHECK(last == Near(0.24).epsilon(1e-13));
}

TEST_CASE("a floating floe's draught is h rho_i / rho_w = 0.27 m", "[water][analytic]") {
    const double height = floating_height(paper_floe(), Mat3::Identity(), 0.9);
    CHECK(0.15 - height == Near(0.27).epsilon(1e-11));
}

TEST_CASE("the righting moment of a floe tilted by 2 degrees is that of metacentric theory",
          "[water][analytic]") {
    const Shape shape = paper_floe();
    const double tilt = 2.0 * std::numbers::pi / 180.0;
    const Mat3 turn = Eigen::AngleAxisd(tilt, Vec3::UnitX()).toRotationMatrix();
    const double height = floating_height(shape, turn, 0.9);
    const Submerged s = measure_submerged(shape, turn, height);
    // GM = KB + I / V - KG of a box: draught d, breadth 0.8
    const double d = 0.27, gm = d / 2 + 0.8 * 0.8 / (12 * d) - 0.15;
    const double expected = -s.volume * gm * std::sin(tilt);
    const double arm = s.centre.y() * s.volume;  // moment about x = y F_z
    CHECK(arm == Near(expected).epsilon(0.01));  // second order in the tilt
}

TEST_CASE("a floe pushed down heaves with period 2 pi sqrt(rho_i h / (rho_w g)) = 1.042 s",
          "[water][analytic]") {
    World w = floating_world(0.001, GENERATE(BuoyancyModel::centre, BuoyancyModel::distributed),
                             DragModel::none);
    const double rest = floating_height(w.scene.shapes[1], Mat3::Identity(), 0.9);
    const std::size_t i =
        add_floe(w.scene, 1, 900.0, Vec3(0, 0, rest - 0.01), Quaternion::Identity(), 0, false);
    // two upward crossings of the rest height are a period apart
    std::vector<double> crossings;
    double last = w.scene.bodies.position[i].z() - rest;
    while (crossings.size() < 3) {
        step(w);
        const double now = w.scene.bodies.position[i].z() - rest;
        if (last < 0.0 && now >= 0.0) crossings.push_back(w.time);
        last = now;
        REQUIRE(w.time < 10.0);
    }
    const double expected = 2.0 * std::numbers::pi * std::sqrt(0.9 * 0.3 / 9.81);
    CHECK(0.5 * (crossings[2] - crossings[0]) == Near(expected).epsilon(0.002));  // dt / period
}

TEST_CASE("a released floe rises at sqrt(2 (rho_w - rho_i) g h / (rho_w C_d)) = 0.767 m/s",
          "[water][analytic]") {
    World w = floating_world(0.01, BuoyancyModel::distributed,
                             GENERATE(DragModel::projected, DragModel::panel));
    const std::size_t i =
        add_floe(w.scene, 1, 900.0, Vec3(0, 0, -50), Quaternion::Identity(), 0, false);
    for (int k = 0; k < 1000; ++k) step(w);
    const double expected = std::sqrt(2.0 * 100.0 * 9.81 * 0.3 / 1000.0);
    CHECK(w.scene.bodies.velocity[i].z() == Near(expected).epsilon(1e-6));
}

TEST_CASE("projected drag of a box is -1/2 rho C_d A |v| v in every direction it faces",
          "[water][analytic]") {
    const Shape shape = paper_floe();
    const Vec3 v = GENERATE(Vec3(2, 0, 0), Vec3(0, -1, 0), Vec3(0, 0, 3), Vec3(1, 1, 1));
    const Vec3 faces(0.8 * 0.3, 1 * 0.3, 1 * 0.8);
    const double area = faces.dot(v.cwiseAbs()) / v.norm();
    const Vec3 still = Vec3::Zero();
    const Mat3 upright = Mat3::Identity();
    const WaterLoad load = projected_drag(shape, {upright, -10.0, v, still}, 1.2, 1000.0);
    const Vec3 expected = -0.5 * 1000.0 * 1.2 * area * v.norm() * v;
    CHECK((load.force - expected).norm() < tolerance(1e-12) * expected.norm());
    CHECK(load.moment == Vec3::Zero());
}

TEST_CASE("panel drag damps a turning plate by C_d rho w^2 b L^4 / 64 on each broad face half",
          "[water][analytic]") {
    // a thin plate turning about y: u = w x on both halves, one half of each broad face leads
    const double length = 2.0, half = 0.01, rate = 1.5;
    const Shape shape = build_shape(test::make_box_set(Vec3(length, 1, 2 * half), 0.01, 0.1), true);
    const Vec3 still = Vec3::Zero(), spin(0, rate, 0);
    const Mat3 upright = Mat3::Identity();
    const WaterLoad load = panel_drag(shape, {upright, -10.0, still, spin}, 1.0, 1000.0);
    // torque = 1/2 rho C_d b w^2 2 int_0^{L/2} x (x^2 + h^2) dx, the ends' with L/2 and h exchanged
    const double broad = std::pow(length, 4) / 64 + std::pow(half * length, 2) / 8;
    const double ends = std::pow(half, 4) / 4 + std::pow(half * length, 2) / 8;
    // rounding of some tens of products
    CHECK(-load.moment.y() == Near(1000.0 * rate * rate * (broad + ends)).epsilon(1e-13));
    CHECK(load.force.norm() < tolerance(1e-12) * load.moment.norm());
}

TEST_CASE("the wetted share of a triangle is that of its area", "[water][analytic]") {
    CHECK(wetted_share(-1, -2, -3) == 1.0);
    CHECK(wetted_share(1, 2, 3) == 0.0);
    CHECK(wetted_share(-1, 1, 1) == Near(0.25));
    CHECK(wetted_share(1, -1, -1) == Near(0.75));
    CHECK(wetted_share(0, 0, -1) == 1.0);
    CHECK(wetted_share(0, 1, -1) == Near(0.5));
}
