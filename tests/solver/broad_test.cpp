// SPDX-License-Identifier: GPL-3.0-or-later
// Which bodies may touch: against the test of all pairs, at once and along a direction.
//
// Tolerances: 1e-12 is rounding of lengths of some metres. 2.02 |q - p| is the angle between two
// quaternions for small angles and at most 2 % more (motion_bounds.cpp).
#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>

#include "solver/broad/find_pairs.hpp"
#include "tests/support/make_worlds.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::tolerance;

TEST_CASE("the broad phase finds the pairs that testing all finds", "[broad][equivalence]") {
    World w = test::scattered_world(GENERATE(1u, 2u, 3u, 4u), 200);
    std::vector<BodyPair> found, expected;
    find_pairs(w.scene, 0.05, found);
    reference::find_pairs(w.scene, 0.05, expected);
    CHECK(expected.size() > 200);
    CHECK(found == expected);
}

TEST_CASE("no floe, one floe and two held floes make no ice-ice pair", "[broad][degenerate]") {
    World w = test::plate_world(test::empty_space(0.01), Vec3(1, 1, 1), 0.1, 0.2, 50.0);
    std::vector<BodyPair> pairs{{1, 2}};
    find_pairs(w.scene, 0.1, pairs);
    CHECK(pairs.empty());
    const auto box = test::add_shape(w, test::make_box_set(Vec3(1, 0.8, 0.3), 0.05, 0.1));
    add_floe(w.scene, box, 900.0, Vec3::Zero(), Quaternion::Identity(), 0, true);
    add_floe(w.scene, box, 900.0, Vec3(0.5, 0, 0), Quaternion::Identity(), 0, true);
    find_pairs(w.scene, 0.1, pairs);
    CHECK(pairs.empty());
}

TEST_CASE("a list of pairs follows a ship, and a floe released far from it, through held floes",
          "[broad][equivalence]") {
    // the ship goes 40 m through held floes; meanwhile one at the other end is released, goes 9 m
    World w = test::scattered_world(5, 600, 1.0, 30.0);
    Bodies& b = w.scene.bodies;
    std::fill(b.held.begin() + 1, b.held.end(), std::uint8_t{1});
    list_moving(b);
    const double direction = GENERATE(1.0, -1.0);  // ahead, and astern
    b.position[kShip].x() = -20.0 * direction;
    b.velocity[kShip] = Vec3(direction, 0, 0);
    std::size_t far = 1;
    for (std::size_t i = 2; i < b.size(); ++i)
        if (direction * b.position[i].x() > direction * b.position[far].x()) far = i;
    const double dt = 0.05, margin = 0.01;
    MotionBounds motion;
    PairList list;
    std::size_t of_ship = 0, of_floe = 0, longest = 0;
    for (int k = 0; k < 800; ++k) {
        if (k == 200) {
            b.held[far] = 0;
            list_moving(b);
            b.velocity[far] = Vec3(-0.3 * direction, 0, 0);
        }
        motion.update(w.scene, dt);
        list.update(w.scene, motion, margin);
        std::vector<BodyPair> expected;
        reference::find_pairs(w.scene, margin, expected);
        REQUIRE(std::includes(list.pairs().begin(), list.pairs().end(), expected.begin(),
                              expected.end()));
        for (const BodyPair& pair : expected) ++(pair.a == 0 ? of_ship : of_floe);
        longest = std::max(longest, list.pairs().size());
        b.position[kShip] += dt * b.velocity[kShip];
        if (k >= 200) b.position[far] += dt * b.velocity[far];
    }
    CHECK(of_ship > 10000);
    CHECK(of_floe > 1000);
    CHECK(longest < 200);  // of 600 floes in 60 m: 60 at a hull of 4 m, and those at the other floe
}

TEST_CASE("a floe whose place is no number is in no pair with floes, and hides no other pair",
          "[broad][degenerate]") {
    World w = test::scattered_world(6, 50);
    Bodies& b = w.scene.bodies;
    std::vector<BodyPair> before, after;
    find_pairs(w.scene, 0.05, before);
    const std::int32_t lost = b.moving[3];
    b.position[lost].setConstant(std::numeric_limits<double>::quiet_NaN());
    find_pairs(w.scene, 0.05, after);
    const auto of_lost = [&](const BodyPair& pair) { return pair.a == lost || pair.b == lost; };
    CHECK(std::erase_if(before, of_lost) > 0);
    std::erase_if(after, of_lost);
    CHECK(after == before);
    // a list is made anew until it is a number again
    MotionBounds motion;
    PairList list;
    for (int k = 0; k < 3; ++k) {
        motion.update(w.scene, 0.01);
        list.update(w.scene, motion, 0.05);
        CHECK(
            std::includes(list.pairs().begin(), list.pairs().end(), before.begin(), before.end()));
    }
}

TEST_CASE("a body that has another shape now begins a path of its own", "[broad]") {
    World w = test::scattered_world(3, 20, 1.0, 10.0);
    Bodies& b = w.scene.bodies;
    MotionBounds motion;
    motion.update(w.scene, 0.01);
    const std::int32_t other = b.moving[0], same = b.moving[1];
    for (const std::int32_t i : {other, same}) {
        b.position[i].x() += 0.5;
        b.orientation[i] = Quaternion(Eigen::AngleAxisd(2.0, Vec3::UnitZ())) * b.orientation[i];
    }
    motion.forget(w.scene, {other});
    motion.update(w.scene, 0.01);
    CHECK(motion.path(other) == 0.0);
    CHECK(motion.rotation(other) == 0.0);
    CHECK(motion.path(same) > 0.5);
}

TEST_CASE("a path is the way of the centre and the angle times the radius and half a metre",
          "[broad][analytic]") {
    constexpr double kAngle = 0.2, kTimeStep = 0.01;
    World w = test::scattered_world(3, 20, 1.0, 10.0);
    Bodies& b = w.scene.bodies;
    const std::int32_t body = b.moving[0];
    const auto i = static_cast<std::size_t>(body);
    const double lever = w.scene.shapes[static_cast<std::size_t>(b.shape[i])].bounding_radius + 0.5;
    MotionBounds motion;
    motion.update(w.scene, kTimeStep);
    b.position[i] += Vec3(3, 0, 4);
    motion.update(w.scene, kTimeStep);
    CHECK(std::abs(motion.path(body) - 5.0) < tolerance(1e-12));

    b.orientation[i] =
        Quaternion(Eigen::AngleAxisd(kAngle, Vec3(1, 2, 2).normalized())) * b.orientation[i];
    b.velocity[i] = Vec3(0, 0.6, 0.8);
    b.angular_velocity[i] = Vec3(0, 0, 2);
    motion.update(w.scene, kTimeStep);
    CHECK(motion.rotation(body) >= kAngle);
    CHECK(motion.rotation(body) < kAngle * (1.0 + tolerance(0.02)));
    CHECK(std::abs(motion.path(body) - 5.0 - motion.rotation(body) * lever) < tolerance(1e-12));
    CHECK(std::abs(motion.path_after_step(body) - motion.path(body) -
                   kTimeStep * (1.0 + 2.0 * lever)) < tolerance(1e-12));
}
