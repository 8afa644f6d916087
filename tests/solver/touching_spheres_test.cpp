// SPDX-License-Identifier: GPL-3.0-or-later
// Listed spheres: which touch, and the same bits on every instruction set.
#include "solver/narrow/neighbours/touching_spheres.hpp"

#include <catch2/catch.hpp>
#include <random>

#include "tests/support/every_instruction_set.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;

namespace {

const FloatPose kPose{{{0.6f, -0.8f, 0.0f}, {0.8f, 0.6f, 0.0f}, {0.0f, 0.0f, 1.0f}},
                      {300.0f, -200.0f, 250.0f}};

ListedSpheres empty_block() {
    ListedSpheres out{};
    std::fill_n(out.radii, ListedSpheres::kPairs,
                static_cast<std::int16_t>(-ListedSpheres::kMost - 1));
    std::fill_n(out.a, ListedSpheres::kPairs, -1);
    std::fill_n(out.b, ListedSpheres::kPairs, -1);
    return out;
}

std::vector<ListedSpheres> random_list(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_int_distribution<std::int16_t> place(-200, 200), radii(100, 300);
    std::vector<ListedSpheres> out;
    for (std::size_t n = 0; n < count; ++n) {
        const std::size_t k = n % ListedSpheres::kPairs;
        if (k == 0) out.push_back(empty_block());
        ListedSpheres& s = out.back();
        for (std::int16_t* values : {s.ax, s.ay, s.az, s.bx, s.by, s.bz}) values[k] = place(random);
        s.radii[k] = radii(random);
        s.a[k] = static_cast<std::int32_t>(3 * n);
        s.b[k] = static_cast<std::int32_t>(7 * n + 1);
    }
    return out;
}

}  // namespace

TEST_CASE("listed spheres of radii 100 and 200 touch at 300 and what is allowed beyond",
          "[narrow][analytic]") {
    std::vector<ListedSpheres> listed{empty_block()};
    ListedSpheres& s = listed.front();
    // b's sphere comes to (300, -200, 250) + 500 (0.6, 0.8, 0), a's is 350 above
    s.bx[5] = 500;
    s.ax[5] = 600;
    s.ay[5] = 200;
    s.az[5] = 600;
    s.radii[5] = 300;
    s.a[5] = 11;
    s.b[5] = 12;
    TouchingSpheres found;
    find_touching(listed, kPose, 49.0f, found);
    CHECK(found.count == 0);
    CHECK(found.least == Near(50.0f));
    find_touching(listed, kPose, 51.0f, found);
    REQUIRE(found.count == 1);
    CHECK(found.a[0] == 11);
    CHECK(found.b[0] == 12);
}

TEST_CASE("an empty list has nothing that touches, and no gap", "[narrow][degenerate]") {
    TouchingSpheres found;
    find_touching({}, kPose, 1.0f, found);
    CHECK(found.count == 0);
    CHECK(found.least == ListedSpheres::kNowhere);
}

TEST_CASE("every instruction set finds the touching spheres of the reference, bit for bit",
          "[narrow][simd]") {
    const std::size_t count =
        GENERATE(0u, 1u, 2u, 3u, 4u, 5u, 7u, 8u, 9u, 12u, 13u, 15u, 16u, 17u, 31u, 32u, 33u, 1000u);
    const auto listed = random_list(count, static_cast<unsigned>(count) + 1);
    const float most = GENERATE(-100.0f, 50.0f, 300.0f, 2000.0f);
    TouchingSpheres expected, found;
    reference::find_touching(listed, kPose, most, expected);
    if (most == 2000.0f) REQUIRE(expected.count == count);
    if (count == 1000 && most < 2000.0f) REQUIRE(expected.count < count);
    if (count == 1000) REQUIRE(expected.count > 0);
    test::on_every_instruction_set([&] {
        find_touching(listed, kPose, most, found);
        REQUIRE(found.count == expected.count);
        CHECK(found.least == expected.least);
        CHECK(std::equal(expected.a.begin(), expected.a.end(), found.a.begin()));
        CHECK(std::equal(expected.b.begin(), expected.b.end(), found.b.begin()));
    });
}
