// SPDX-License-Identifier: GPL-3.0-or-later
// Which of the spheres that may touch some time are looked at in a step.
#include "solver/narrow/decisive_spheres.hpp"

#include <catch2/catch.hpp>
#include <random>
#include <set>
#include <utility>
#include <vector>

using namespace ice;

namespace {

using Picked = std::multiset<std::pair<std::int32_t, std::int32_t>>;

Picked picked_of(DecisiveSpheres& decisive, const std::vector<SpherePair>& near, double gone,
                 double gap) {
    std::vector<SpherePair> picked;
    decisive.begin(31, 31);
    decisive.pick(near, gone, gap, picked);
    Picked out;
    for (const SpherePair& s : picked) out.emplace(s.a, s.b);
    return out;
}

}  // namespace

TEST_CASE("spheres that cannot come within the gap are left out, unless they share one that can",
          "[narrow][dormant]") {
    DecisiveSpheres decisive;
    const std::vector<SpherePair> near{{0, 0, 0.010f},   // may touch
                                       {0, 1, 0.040f},   // shares a's 0
                                       {7, 0, 0.040f},   // shares b's 0
                                       {7, 1, 0.040f},   // shares them with those only
                                       {8, 9, 0.040f}};  // far from all
    CHECK(picked_of(decisive, near, 0.009, 0.0009).empty());
    CHECK(picked_of(decisive, near, 0.009, 0.0011) == Picked{{0, 0}, {0, 1}, {7, 0}});
    CHECK(picked_of(decisive, near, 0.0, 0.05).size() == near.size());
    CHECK(picked_of(decisive, {}, 0.0, 1.0).empty());  // and no mark is left from the last call
    CHECK(picked_of(decisive, {{0, 0, 0.04f}}, 0.0, 0.01).empty());
}

TEST_CASE("what is picked of many spheres is what their definition says", "[narrow][dormant]") {
    std::mt19937 random(11);
    std::uniform_int_distribution<std::int32_t> sphere(0, 30);
    std::uniform_real_distribution<float> least(0.0f, 0.1f);
    DecisiveSpheres decisive;
    for (int trial = 0; trial < 50; ++trial) {
        std::vector<SpherePair> near;
        for (int k = 0; k < 60; ++k)
            near.push_back({sphere(random), sphere(random), least(random)});
        Picked expected;
        for (const SpherePair& s : near)
            for (const SpherePair& other : near)
                if (other.least <= 0.01f && (other.a == s.a || other.b == s.b)) {
                    expected.emplace(s.a, s.b);
                    break;
                }
        CHECK(picked_of(decisive, near, 0.0, 0.01f) == expected);
    }
}
