// SPDX-License-Identifier: GPL-3.0-or-later
// Which bodies may touch: against the test of all pairs, at once and along a way.
#include <catch2/catch.hpp>
#include <random>

#include "solver/broad/find_pairs.hpp"
#include "tests/support/make_worlds.hpp"

using namespace ice;

namespace {

// Floes of 1 m at random poses up to `far` m ahead and astern of a hull of 4 m, a third held.
World scattered_world(unsigned seed, int floes, double far, double speed = 0.0) {
    Case p = test::empty_space(0.01);
    p.speed_table = {{0.0, speed}};
    World w = test::plate_world(p, Vec3(4, 2, 0.6), 0.1, 0.15, -0.3);
    const auto box = test::add_shape(w, test::make_box_set(Vec3(1, 0.8, 0.3), 0.05, 0.1));
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (int k = 0; k < floes; ++k) {
        const Vec3 at(far * unit(random), 2.0 * unit(random), unit(random));
        const Quaternion q(unit(random), unit(random), unit(random), unit(random));
        add_floe(w.scene, box, 900.0, at, q.normalized(), 0, k % 3 == 0);
    }
    return w;
}

}  // namespace

TEST_CASE("the broad phase finds the pairs that testing all finds", "[broad][equivalence]") {
    World w = scattered_world(GENERATE(1u, 2u, 3u, 4u), 200, 3.0);
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

TEST_CASE("held floes far from all that moves make no pair but with those that come",
          "[broad][equivalence]") {
    // the ship goes 40 m through held floes, with one before it that moves ahead of it from 10 m on
    World w = scattered_world(5, 600, 30.0, 1.0);
    Bodies& b = w.scene.bodies;
    b.position[kShip].x() = -20.0;
    std::fill(b.held.begin() + 1, b.held.end(), std::uint8_t{1});
    b.moving.clear();
    const double dt = 0.05, margin = 0.01;
    Travel travel;
    PairList list;
    std::size_t compared = 0, longest = 0;
    for (int k = 0; k < 800; ++k) {
        if (k == 200) {
            b.held[7] = 0;
            b.moving.push_back(7);
            b.position[7] = b.position[kShip] + Vec3(6, 0.3, 0);
            b.velocity[7] = Vec3(1, 0, 0);
        }
        travel.update(w.scene, dt);
        list.update(w.scene, travel, margin);
        std::vector<BodyPair> expected;
        reference::find_pairs(w.scene, margin, expected);
        REQUIRE(std::includes(list.pairs().begin(), list.pairs().end(), expected.begin(),
                              expected.end()));
        compared += expected.size();
        longest = std::max(longest, list.pairs().size());
        for (const std::size_t i : {kShip, std::size_t{7}}) b.position[i] += dt * b.velocity[i];
    }
    CHECK(compared > 10000);
    CHECK(longest < 200);  // 600 floes in 60 m: 40 at a hull of 4 m, and floe 7's neighbours
}
