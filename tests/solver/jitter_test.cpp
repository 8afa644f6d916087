// SPDX-License-Identifier: GPL-3.0-or-later
// Members of an ensemble: small random offsets that depend on seed and floe alone.
//
// Tolerances: 1e-15 is rounding of a rotation's entries, of the order of one.
#include <catch2/catch.hpp>
#include <cmath>

#include "solver/scene/apply_jitter.hpp"
#include "tests/support/make_worlds.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::tolerance;

namespace {

constexpr double kJitter = 0.05;  // [m]

Case parameters(int seed, double jitter = kJitter) {
    Case p = test::empty_space(0.01);
    p.seed = seed;
    p.jitter = jitter;
    p.floes.resize(2);
    p.floes[1].hold = Hold::always;
    return p;
}

// Floes in a row behind a hull, turned a little; every fifth is held for good.
Scene row(int floes) {
    World w = test::plate_world(parameters(0), Vec3(1, 1, 1), 0.1, 0.2, 50.0);
    const auto box = test::add_shape(w, test::make_box_set(test::kPaperFloe, 0.05, 0.1));
    for (int k = 0; k < floes; ++k) {
        const int group = k % 5 == 4 ? 1 : 0;
        add_floe(w.scene, box, 900.0, Vec3(1.5 * k, 0.1 * k, -0.2),
                 Quaternion(Eigen::AngleAxisd(0.2 * k, Vec3(1, 2, 3).normalized())), group,
                 group == 1);
    }
    return w.scene;
}

Scene jittered(int floes, const Case& p) {
    Scene scene = row(floes);
    apply_jitter(scene, p);
    return scene;
}

bool held_for_good(const Scene& scene, std::size_t i) { return scene.bodies.group[i] == 1; }

bool same_pose(const Scene& l, const Scene& r, std::size_t i) {
    return l.bodies.position[i] == r.bodies.position[i] &&
           l.bodies.orientation[i].coeffs() == r.bodies.orientation[i].coeffs() &&
           l.bodies.rotation[i] == r.bodies.rotation[i];
}

}  // namespace

TEST_CASE("offsets and turns are spread over their whole range and no more",
          "[scene][jitter][analytic]") {
    constexpr int kFloes = 500;
    const Scene before = row(kFloes), after = jittered(kFloes, parameters(3));
    const double most_turn = kJitter / (0.5 * test::kPaperFloe.x());  // half the longest side
    Vec3 largest = Vec3::Zero(), sum = Vec3::Zero();
    int moved = 0;
    for (std::size_t i = 1; i < before.bodies.size(); ++i) {
        if (held_for_good(before, i)) continue;
        ++moved;
        const Vec3 shift = after.bodies.position[i] - before.bodies.position[i];
        const Quaternion turn =
            after.bodies.orientation[i] * before.bodies.orientation[i].conjugate();
        const double angle = 2.0 * std::atan2(turn.z(), turn.w());
        REQUIRE(shift.z() == 0.0);
        REQUIRE(std::hypot(turn.x(), turn.y()) < tolerance(1e-15));  // about the vertical
        const Vec3 offset(shift.x() / kJitter, shift.y() / kJitter, angle / most_turn);
        REQUIRE(offset.cwiseAbs().maxCoeff() <=
                1.0 + tolerance(1e-12));  // positions up to 750 m are rounded
        largest = largest.cwiseMax(offset.cwiseAbs());
        sum += offset;
    }
    REQUIRE(moved == 400);
    // of 400 numbers uniform in (-1, 1) the largest is below 0.97 once in 2e5 times, and their mean
    // has a standard deviation of 1 / sqrt(3 x 400)
    CHECK(largest.minCoeff() > 0.97);
    CHECK((sum / moved).cwiseAbs().maxCoeff() < 4.0 / std::sqrt(3.0 * moved));
}

TEST_CASE("the same seed gives the same offsets, another seed others", "[scene][jitter]") {
    const Scene first = jittered(20, parameters(7)), again = jittered(20, parameters(7));
    const Scene other = jittered(20, parameters(8));
    for (std::size_t i = 1; i < first.bodies.size(); ++i) {
        REQUIRE(same_pose(first, again, i));
        REQUIRE(same_pose(first, other, i) == held_for_good(first, i));
    }
}

TEST_CASE("one more floe leaves the others' offsets", "[scene][jitter]") {
    const Scene few = jittered(12, parameters(7)), more = jittered(13, parameters(7));
    for (std::size_t i = 0; i < few.bodies.size(); ++i) REQUIRE(same_pose(few, more, i));
    CHECK_FALSE(same_pose(row(13), more, 13));
}

TEST_CASE("ship and floes held for good stay, all others move", "[scene][jitter]") {
    const Scene before = row(20), after = jittered(20, parameters(7));
    CHECK(same_pose(before, after, kShip));
    for (std::size_t i = 1; i < before.bodies.size(); ++i)
        REQUIRE(same_pose(before, after, i) == held_for_good(before, i));
}

TEST_CASE("the derived rotation is that of the new orientation", "[scene][jitter]") {
    const Scene after = jittered(3, parameters(7));
    for (std::size_t i = 1; i < after.bodies.size(); ++i)
        CHECK((after.bodies.rotation[i] - after.bodies.orientation[i].toRotationMatrix()).norm() <
              tolerance(1e-15));
}

TEST_CASE("2D floes move along x only", "[scene][jitter]") {
    World w;
    w.scene = make_scene(build_shape(test::make_box_set(Vec3(1, 1, 1), 0.1, 0.2, 2), false),
                         Vec3(0, 0, 5), Vec3::Zero());
    const auto box = test::add_shape(w, test::make_box_set(Vec3(1, 1, 0.3), 0.05, 0.1, 2));
    REQUIRE(w.scene.dimension == 2);
    for (int k = 0; k < 10; ++k)
        add_floe(w.scene, box, 900.0, Vec3(1.5 * k, 0, 0),
                 Quaternion(Eigen::AngleAxisd(0.1 * k, Vec3::UnitY())), 0, false);
    const Bodies before = w.scene.bodies;
    apply_jitter(w.scene, parameters(7));
    for (std::size_t i = 1; i < before.size(); ++i) {
        const Vec3 shift = w.scene.bodies.position[i] - before.position[i];
        REQUIRE(shift.x() != 0.0);
        REQUIRE(std::abs(shift.x()) <= kJitter);
        REQUIRE(shift.y() == 0.0);
        REQUIRE(shift.z() == 0.0);
        REQUIRE(w.scene.bodies.orientation[i].coeffs() == before.orientation[i].coeffs());
    }
}

TEST_CASE("no jitter changes nothing, whatever the seed", "[scene][jitter]") {
    const Scene before = row(6), after = jittered(6, parameters(GENERATE(0, 7), 0.0));
    for (std::size_t i = 0; i < before.bodies.size(); ++i) REQUIRE(same_pose(before, after, i));
}
