// SPDX-License-Identifier: GPL-3.0-or-later
// What is said of a case before its first step: bodies in each other, steps too long.
#include <catch2/catch.hpp>

#include "common/formats/widest_spacing.hpp"
#include "solver/run/check_start.hpp"
#include "solver/scene/tunnelling_speed.hpp"
#include "tests/common/fixtures.hpp"
#include "tests/support/make_worlds.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using namespace ice::test;

namespace {

constexpr double kRadius = 0.05, kSpacing = 0.1;  // of all floes here [m]

// A hull of 4 x 2 x 1 m with its bottom at z = 0, and floes of 1 x 1 x 0.4 m where they are wanted.
World world_of(const std::vector<Vec3>& places, bool held = false) {
    Case p = empty_space(0.01);
    p.file = "case.cfg";
    World w = plate_world(p, Vec3(4, 2, 1), 0.1, 0.2, 0.0);
    const auto row = add_shape(w, make_box_set(Vec3(1, 1, 0.4), kRadius, kSpacing));
    for (const Vec3& place : places)
        add_floe(w.scene, row, 900.0, place, Quaternion::Identity(), 0, held);
    return w;
}

std::vector<StartOverlap> overlaps_of(World& w) {
    return find_start_overlaps(w.scene, w.parameters);
}

}  // namespace

TEST_CASE("floes that touch or stand apart do not overlap at the start", "[step]") {
    const double apart = GENERATE(0.0, 1e-9, 0.3);
    const bool held = GENERATE(false, true);
    World w = world_of({Vec3(0, 0, -0.2 - apart), Vec3(1 + apart, 0, -0.2 - apart),
                        Vec3(0, -1 - apart, -0.2 - apart)},
                       held);
    CHECK(overlaps_of(w).empty());
    CHECK(check_start(w, false).empty());
}

TEST_CASE("a floe that reaches into its neighbour is named with the depth", "[step][errors]") {
    // from just above the tolerance, 0.02 x 0.05 m, to deeper than the spheres
    const double depth = GENERATE(0.0011, 0.003, 0.03, 0.2, 0.35);
    const bool held = GENERATE(false, true);
    CAPTURE(depth, held);
    World w = world_of({Vec3(0, 0, -1), Vec3(1 - depth, 0, -1), Vec3(0, 3, -1)}, held);
    const auto found = overlaps_of(w);
    REQUIRE(found.size() == 1);
    CHECK(found[0].a == 1);
    CHECK(found[0].b == 2);
    // as far as they must be moved until they are separate: up, past the floes' 0.4 m, it is
    // farther than back
    CHECK(found[0].depth == Near(depth).margin(depth < kRadius ? 1e-6 : 0.5 * kSpacing));
    const std::string text = error_text([&] { check_start(w, false); });
    CHECK_THAT(text, Catch::StartsWith("case.cfg: floe 1 and floe 2 overlap by") &&
                         Catch::Contains("at the start, at x = ") && Catch::Contains("floes.gap") &&
                         Catch::Contains("--allow-overlap"));
    const auto warnings = check_start(w, true);
    REQUIRE(warnings.size() == 1);
    CHECK_THAT(warnings[0].text, Catch::StartsWith("floe 1 and floe 2 overlap by"));
}

TEST_CASE("overlap up to a fiftieth of the spheres' radius is tolerated", "[step]") {
    World w = world_of({Vec3(0, 0, -1), Vec3(1 - 0.0009, 0, -1)});
    CHECK(overlaps_of(w).empty());
}

TEST_CASE("a floe wholly inside the hull, where no surfaces meet, is named", "[step][errors]") {
    World w = world_of({Vec3(5, 0, -1), Vec3(0.3, 0.1, 0.5)});
    const auto found = overlaps_of(w);
    REQUIRE(found.size() == 1);
    CHECK(found[0].a == 0);
    CHECK(found[0].b == 2);
    CHECK(found[0].inside == 2);
    CHECK_THAT(error_text([&] { check_start(w, false); }),
               Catch::Contains("floe 2 lies wholly inside the hull: they overlap by"));
}

TEST_CASE("a floe inside another one, and two in the same place, are named", "[step][errors]") {
    World w = world_of({Vec3(0, 3, -1), Vec3(0, 3, -1), Vec3(5, 0, -1)}, true);
    const auto big = add_shape(w, make_box_set(Vec3(3, 3, 2), 0.1, 0.2));
    add_floe(w.scene, big, 900.0, Vec3(5, 0, -1), Quaternion::Identity(), 0, true);
    const auto found = overlaps_of(w);
    REQUIRE(found.size() == 2);
    CHECK(found[0].a == 3);
    CHECK(found[0].b == 4);
    CHECK(found[0].inside == 3);
    CHECK(found[1].a == 1);
    CHECK(found[1].b == 2);
    CHECK(found[1].inside >= 1);
}

TEST_CASE("unbroken ice may overlap unbroken ice, but no floe", "[step]") {
    World w = world_of({Vec3(0, 3, -1), Vec3(0.5, 3, -1)}, true);
    w.parameters.floes[0].hold = Hold::always;
    CHECK(overlaps_of(w).empty());
    w.parameters.floes.push_back(w.parameters.floes[0]);
    w.parameters.floes[1].hold = Hold::never;
    w.scene.bodies.group[2] = 1;
    CHECK(overlaps_of(w).size() == 1);
}

TEST_CASE("looking for overlaps changes nothing", "[step]") {
    World w = world_of({Vec3(0, 0, -0.1), Vec3(0.9, 0, -1)}, true);
    const auto held = w.scene.bodies.held;
    CHECK_FALSE(overlaps_of(w).empty());
    CHECK(w.scene.bodies.held == held);
    CHECK(w.scene.bodies.moving.empty());
}

TEST_CASE("many overlaps are counted, the deepest five are named", "[step][errors]") {
    std::vector<Vec3> places;
    for (int k = 0; k < 8; ++k) places.emplace_back(0.9 * k, 5.0, -1.0);
    World w = world_of(places);
    const std::string text = error_text([&] { check_start(w, false); });
    CHECK(std::count(text.begin(), text.end(), '\n') == 6);
    CHECK_THAT(text, Catch::Contains("and 2 pairs more"));
}

TEST_CASE("a ship or floe that goes a sphere's diameter in a step is warned of, with the limit",
          "[step]") {
    World w = world_of({Vec3(0, 5, -1)});
    CHECK(tunnelling_speed(w.scene, 0.01) == Near(10.0));  // 2 x 0.05 m / 0.01 s
    w.parameters.speed_table = {{0.0, 9.9}};
    CHECK(check_start(w, false).empty());
    w.parameters.duration = 10.0;
    w.parameters.speed_table = {{0.0, 1.0}, {10.0, -20.0}, {20.0, 49.0}};
    auto warnings = check_start(w, false);
    REQUIRE(warnings.size() == 1);
    CHECK_THAT(warnings[0].text, Catch::Contains("the ship moves at 20 m/s") &&
                                     Catch::Contains("above 10 m/s") &&
                                     Catch::Contains("simulation.time_step to 0.005 s"));
    w.parameters.speed_table = {{0.0, 1.0}};
    w.scene.bodies.velocity[1] = Vec3(0, 0, 12.0);
    warnings = check_start(w, false);
    REQUIRE(warnings.size() == 1);
    CHECK_THAT(warnings[0].text, Catch::Contains("floe 1, seen from the ship, moves at 12 m/s"));
}

TEST_CASE("spheres too far apart to keep others out are warned of, with the limit of the rule",
          "[step]") {
    World w = world_of({});
    const auto add = [&](double radii) {
        const auto row = add_shape(w, make_box_set(Vec3(1, 1, 0.4), kRadius, radii * kRadius));
        const double x = 2.0 * static_cast<double>(w.scene.bodies.size());
        add_floe(w.scene, row, 900.0, Vec3(x, 5, -1), Quaternion::Identity(), 0, false);
    };
    add(2.0);
    w.parameters.normal = NormalRule::centres;
    CHECK(check_start(w, false).empty());
    add(kWidestSpacing);
    auto warnings = check_start(w, false);
    REQUIRE(warnings.size() == 1);
    CHECK_THAT(warnings[0].text,
               Catch::Contains("spheres of floe 2 are 0.15 m apart") &&
                   Catch::Contains("above 2 radii corners may pass between them") &&
                   Catch::Contains("contact.normal = \"centres\"") &&
                   Catch::Contains("a spacing of 0.1 m"));
    w.parameters.normal = NormalRule::surface;
    CHECK(check_start(w, false).empty());
    add(kWidestSpacing + 0.1);
    warnings = check_start(w, false);
    REQUIRE(warnings.size() == 1);
    CHECK_THAT(warnings[0].text,
               Catch::Contains("spheres of floe 3 are 0.155 m apart") &&
                   Catch::Contains("above 3 radii corners may pass between them:") &&
                   Catch::Contains("a spacing of 0.15 m"));
}
