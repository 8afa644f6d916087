// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies that meet as solids: however deep they are in each other, however they move, and the ship.
#include "solver/narrow/feature/solid_pair.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <tuple>
#include <vector>

#include "solver/integrate/rotation.hpp"
#include "solver/narrow/feature/nearest_sphere.hpp"
#include "solver/narrow/find_contacts.hpp"
#include "solver/step/step.hpp"
#include "tests/support/dice.hpp"
#include "tests/support/make_sphere_sets.hpp"
#include "tests/support/make_worlds.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;
using ice::test::tolerance;

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

// Two boxes of this size, bodies 1 and 2, far from the hull, the second so far from the first.
World two_boxes(const Vec3& size, double radius, double spacing, const Vec3& apart) {
    World w = test::plate_world(test::empty_space(0.01), Vec3(4, 2, 1), 0.25, 0.5, 100.0);
    const auto row = test::add_shape(w, test::make_box_set(size, radius, spacing));
    for (int k = 0; k < 2; ++k)
        add_floe(w.scene, row, 900.0, k * apart, Quaternion::Identity(), 0, false);
    return w;
}

double deepest(const std::vector<Contact>& contacts) {
    double gap = 0.0;
    for (const Contact& c : contacts) gap = std::min(gap, c.gap);
    return gap;
}

}  // namespace

TEST_CASE("a pair stays found whatever its depth, with its true depth and the shortest way out",
          "[narrow][analytic]") {
    // spheres alone lose such boxes from two radii, 0.5 m, on
    const Vec3 size(8, 4, 1);
    const bool crushes = GENERATE(false, true);
    const double depth = GENERATE(0.05, 0.2, 0.4, 0.48, 0.52, 0.7, 0.9);
    const int axis = GENERATE(0, 1, 2);
    if (axis < 2 && depth > 0.48) return;  // deeper, a metre thick, they part upwards
    Vec3 apart = Vec3(0.3, 0.2, 0.1) * (depth > 0.45 ? 0.1 : 1.0);
    apart[axis] = size[axis] - depth;
    const World w = two_boxes(size, 0.25, 0.7, apart);
    std::vector<Contact> found, expected;
    ContactFinder().find(w.scene, {{1, 2}}, {NormalRule::surface, crushes}, 0.0, 0.0, found);
    reference::find_contacts(w.scene, {1, 2}, {NormalRule::surface, crushes}, 0.0, expected);
    REQUIRE_FALSE(found.empty());
    CHECK(found.size() == expected.size());
    CHECK(deepest(found) == Near(-depth).epsilon(1e-6));  // normals of creases are floats
    for (const Contact& c : found) {
        CHECK(c.normal.dot(Vec3::Unit(axis)) > 0.999);
        CHECK(c.is_of_solids());
        CHECK(std::isfinite(c.section) == crushes);
    }
}

TEST_CASE("deep pairs part, step by step, whether their ice can be crushed or not",
          "[narrow][analytic]") {
    const double pressure = GENERATE(kInfinite, 1e6);
    World w = two_boxes(Vec3(8, 4, 1), 0.25, 0.7, Vec3(0.3, 0.2, 0.35));  // 0.65 m deep
    w.parameters.contact.crushing_pressure = pressure;
    for (int k = 0; k < 400; ++k) step(w);
    const Bodies& b = w.scene.bodies;
    const Vec3 apart = b.rotation[1].transpose() * (b.position[2] - b.position[1]);
    if (std::isinf(pressure)) CHECK(apart.z() > 1.0 - 0.01);
    // crushed or separated, nothing is left that the finder would still have to push out
    std::vector<Contact> contacts;
    ContactFinder().find(w.scene, {{1, 2}}, ContactRule(w.parameters), 0.0, 0.0, contacts);
    CHECK(deepest(contacts) > -0.01);
}

TEST_CASE("of more than four corners the ones that stay open in the step are left out",
          "[narrow][analytic]") {
    // One square lies on another in an octagon 4 m broad. It overlaps by 1 mm at one end and is
    // open by 7 mm at the other, where it falls by 8 mm in the step or not at all.
    const double dt = 0.01, slope = 2e-3;
    const bool falls = GENERATE(false, true);
    const Vec3 y = Vec3::UnitY(), z = Vec3::UnitZ();
    World w = two_boxes(Vec3(4, 4, 1), 0.25, 0.7, Vec3(0, 0, 1.0 + 2.0 * slope - 1e-3));
    Bodies& b = w.scene.bodies;
    b.orientation[2] = Eigen::AngleAxisd(-slope, y) * Eigen::AngleAxisd(std::numbers::pi / 4, z);
    b.rotation[2] = b.orientation[2].toRotationMatrix();
    if (falls) b.angular_velocity[2] = 4e-3 / dt * y;
    std::vector<Contact> found;
    ContactFinder().find(w.scene, {{1, 2}}, {NormalRule::surface, false}, dt, 0.01, found);
    REQUIRE(found.size() == 4);
    double left = kInfinite, right = -kInfinite;
    for (const Contact& c : found) {
        left = std::min(left, c.point.x());
        right = std::max(right, c.point.x());
    }
    CHECK(left < -1.9);
    CHECK((right > 1.9) == falls);
}

TEST_CASE("the motion of a pair in a step is that of its points", "[narrow][property]") {
    test::Dice dice{std::mt19937(11)};
    const double dt = 0.02, h = 1e-7;
    for (int k = 0; k < 20; ++k) {
        World w = two_boxes(Vec3(4, 4, 1), 0.25, 0.7, Vec3(3, 2, 1));
        Bodies& b = w.scene.bodies;
        b.ship.free = k % 2 == 0;  // its velocity is that of its centre of gravity
        if (b.ship.free) b.ship.centre = 20.0 * dice.vector();
        for (std::size_t i = 0; i < 2; ++i) {
            b.position[i] = 0.5 * dice.vector();
            b.orientation[i] = exponential_map(dice.vector());
            b.rotation[i] = b.orientation[i].toRotationMatrix();
            b.velocity[i] = dice.vector();
            b.angular_velocity[i] = dice.vector();
        }
        const Vec3 point = dice.vector();  // in the ship's axes, and in both boxes' spheres
        const PairView view(w.scene, {0, 1});
        const Vec3 got = PairStep(view, dt).relative().at(point);
        // both bodies a little later, and the place of b's point in the ship's axes then
        Vec3 position[2];
        Mat3 rotation[2];
        for (std::size_t i = 0; i < 2; ++i) {
            const Mat3 turn = exponential_map(h * b.angular_velocity[i]).toRotationMatrix();
            const Vec3 lever = -b.arm(static_cast<std::int32_t>(i), b.position[i]);
            position[i] = b.position[i] + lever + h * b.velocity[i] - turn * lever;
            rotation[i] = turn * b.rotation[i];
        }
        const Vec3 of_b = view.to_b(point);
        const Vec3 later =
            rotation[0].transpose() * (rotation[1] * of_b + position[1] - position[0]);
        CHECK((got - dt / h * (later - point)).norm() < tolerance(1e-5));
        CHECK(got.norm() <= dt * closing_speed(w.scene, {0, 1}));
    }
}

TEST_CASE("in rigid ice a convex hull meets convex floes as solids, and its spheres have the loads",
          "[narrow][analytic]") {
    World w = test::plate_world(test::empty_space(0.01), Vec3(4, 2, 1), 0.25, 0.5, -0.5);
    const auto row = test::add_shape(w, test::make_box_set(Vec3(8, 1.5, 1), 0.25, 0.7));
    // its side reaches 0.03 m into the hull's, and beyond both ends of it
    add_floe(w.scene, row, 900.0, Vec3(0.0, 1.75 - 0.03, 0.25), Quaternion::Identity(), 0, false);
    std::vector<Contact> found, crushed;
    ContactFinder().find(w.scene, {{0, 1}}, {NormalRule::surface, false}, 0.0, 0.0, found);
    ContactFinder().find(w.scene, {{0, 1}}, {NormalRule::surface, true}, 0.0, 0.0, crushed);
    REQUIRE(found.size() == 4);
    CHECK(crushed.size() > 4);  // these are spheres
    const Shape& hull = w.scene.shape_of(0);
    for (const Contact& c : found) {
        CHECK(c.gap == Near(-0.03).epsilon(1e-9));
        CHECK((c.normal - Vec3::UnitY()).norm() < tolerance(1e-9));
        CHECK(std::abs(c.point.x()) == Near(2.0).margin(1e-3));
        CHECK(c.sphere_a == nearest_sphere(hull, c.point));
        CHECK(c.region == hull.region.at(c.sphere_a, c.normal));
        CHECK(std::isinf(c.section));
    }
}

TEST_CASE("the nearest sphere is that, and of equals the one that mirror images have in common",
          "[narrow]") {
    const Shape shape = build_shape(test::make_box_set(Vec3(2, 1, 0.5), 0.125, 0.25), true);
    for (std::size_t k = 0; k < shape.center.size(); ++k)
        CHECK(nearest_sphere(shape, shape.center[k]) == static_cast<std::int32_t>(k));
    // several clusters of spheres, points inside and outside
    const Shape large = build_shape(test::make_box_set(Vec3(8, 4, 1), 0.125, 0.25), true);
    REQUIRE(large.center.size() > 1000);
    test::Dice dice{std::mt19937(5)};
    for (int k = 0; k < 500; ++k) {
        const Vec3 at = dice.vector().cwiseProduct(Vec3(6, 3, 1));
        auto least = std::tuple(kInfinite, std::int32_t{0}, std::int32_t{0});
        for (std::size_t row = 0; row < large.center.size(); ++row)
            least =
                std::min(least, std::tuple((large.center[row] - at).squaredNorm(),
                                           large.mirror_rank[row], static_cast<std::int32_t>(row)));
        REQUIRE(nearest_sphere(large, at) == std::get<2>(least));
    }
    const auto port = nearest_sphere(shape, Vec3(0.9, 0.4, 0.01)),
               starboard = nearest_sphere(shape, Vec3(0.9, -0.4, 0.01));
    CHECK(shape.mirror_rank[static_cast<std::size_t>(port)] ==
          shape.mirror_rank[static_cast<std::size_t>(starboard)]);
}
