// SPDX-License-Identifier: GPL-3.0-or-later
// What is said of level ice before a run and after it: the ship's place, the sheet's size, its
// spheres.
//
// Tolerances: 1e-6 m is the lattice of outlines, 1 nm, along a stem that is not upright.
#include "solver/run/check_sheet.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "solver/record/measure_particulars.hpp"
#include "solver/run/check_course.hpp"
#include "solver/run/check_start.hpp"
#include "solver/run/describe_case.hpp"
#include "solver/run/describe_cost.hpp"
#include "solver/run/sheet_course.hpp"
#include "tests/support/make_strips.hpp"
#include "tests/support/small_icebreaker.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using namespace ice::test;

namespace {

// The ice's upper face is 0.03 m above the water. There the stem of the wedge, 1.4 m high and 2.8 m
// long, is at this x of the ship [m]; on deck it is at x = 6.
constexpr double kStem = 3.2 + 2.8 * 0.83 / 1.4;

// The wedge with its origin there, in front of ice from x = 0 to 40 m and y = -8 to 8 m.
World wedge_at(double x, double y = 0.0, double speed = 0.8) {
    Case p = sheet_case(speed, 20.0);
    p.file = "case.cfg";
    p.hull_position = Vec3(x, y, 0);
    return make_world(p);
}

std::string start_text(World w) {
    std::string out;
    for (const Warning& warning : check_start(w, true)) out += warning.text + "\n";
    return out;
}

std::string course_text(const World& w) {
    std::string out;
    for (const Warning& warning : check_course(w)) {
        CHECK(warning.affects_mean == true);
        out += warning.text + "\n";
    }
    return out;
}

}  // namespace

TEST_CASE("the way to level ice is measured at the ice's height, not on deck",
          "[level_ice][edge][analytic]") {
    const World w = wedge_at(-5.8);
    CHECK(measure_course(w).clearance == Near(5.8 - kStem).margin(1e-6));
    CHECK(measure_course(w).through == Near(45.8 - kStem).margin(1e-6));
    CHECK_THAT(describe_case(w), Catch::Contains("clearance  0.94 m to the level ice\n"));
    // a ship that backs meets the ice with its stern, 6 m behind its origin
    const World back = wedge_at(46.5, 0.0, -0.8);
    CHECK(measure_course(back).clearance == Near(0.5).margin(1e-6));
    CHECK(check_course(back).empty());
}

TEST_CASE("a ship that meets no level ice is told why", "[level_ice][edge][errors]") {
    CHECK_THAT(course_text(wedge_at(-5.8, 12.0)),
               Catch::Contains("passes beside the level ice, which lies from y = -8 to 8 m"));
    CHECK_THAT(course_text(wedge_at(60.0)), Catch::Contains("no ice lies on the ship's course"));
    CHECK_THAT(course_text(wedge_at(-5.8, 0.0, -0.8)), Catch::Contains("the ship moves astern"));
    CHECK_THAT(course_text(wedge_at(-50.0)), Catch::Contains("never meets the ice"));
    Case p = sheet_case(0.8, 60.0);
    p.hull_position.x() = -4.9;
    CHECK_THAT(course_text(make_world(p)), Catch::Contains("a longer level_ice.extent"));
}

TEST_CASE("a ship that lies in level ice is refused with a place before it",
          "[level_ice][edge][errors]") {
    World w = wedge_at(20.0);
    CHECK_THAT(error_text([&] { check_start(w, false); }),
               Catch::StartsWith("case.cfg: the hull lies in the level ice at the start: the run "
                                 "takes ") &&
                   Catch::Contains(" m2 of the sheet out before its first step") &&
                   Catch::Contains("hull.position") && Catch::Contains("with x = -4.9 m its bow"));
    CHECK_THAT(start_text(wedge_at(20.0)), Catch::Contains("the hull lies in the level ice"));
    // a stem that just touches is no fault, and a quarter of a thickness is not seen
    for (const double x : {-4.9, -kStem, -kStem + 0.05}) {
        World touching = wedge_at(x);
        CHECK(check_start(touching, false).empty());
    }
    // beside the sheet the hull would have to move as far
    CHECK(start_text(wedge_at(20.0, 12.0)).empty());
    World back = wedge_at(20.0, 0.0, -0.8);
    CHECK_THAT(error_text([&] { check_start(back, false); }),
               Catch::Contains("with x = 46 m its stern"));
    Case strip = soft_case(1.0, 2.0);
    strip.hull_position.x() = 20.0;
    World in_strip = soft_world(strip);
    CHECK_THAT(error_text([&] { check_start(in_strip, false); }),
               Catch::Contains(" m of the sheet out"));
    World before_strip = soft_world(soft_case(1.0, 2.0));
    CHECK(check_start(before_strip, false).empty());
}

TEST_CASE("level ice that the ship's cracks break at its sides is too narrow",
          "[level_ice][edge][errors]") {
    Case p = sheet_case(0.8, 20.0);
    // cracks of 0.99 m; the deck's sides are at 2 m, those of the ice's upper face at 1.76 m
    p.level_ice.extent = {0.0, 40.0, -2.6, 8.0};
    const std::string text = start_text(make_world(p));
    CHECK_THAT(text, Catch::Contains("level_ice.extent has ice from y = -2.6 to 8 m, and the hull "
                                     "reaches from -1.76 to 1.76 m") &&
                         Catch::Contains("give it y from -4 to 4 m or more"));
    p.level_ice.extent = {0.0, 40.0, -2.7, 2.7};
    CHECK(start_text(make_world(p)).empty());
    p.level_ice.extent = {0.0, 40.0, 1.0, 8.0};
    CHECK_THAT(start_text(make_world(p)),
               Catch::Contains("part of the hull passes beside the sheet"));
}

TEST_CASE("spheres of level ice too far apart are named with their key",
          "[level_ice][edge][errors]") {
    Case p = sheet_case(0.8, 20.0);
    p.level_ice.spacing = 0.225;  // three quarters of 0.3 m
    CHECK(start_text(make_world(p)).empty());
    p.level_ice.spacing = 0.4;
    World w = make_world(p);
    const auto warnings = check_start(w, false);
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0].affects_mean == true);
    CHECK_FALSE(warnings[0].share);
    CHECK_THAT(warnings[0].text,
               Catch::StartsWith("level_ice.spacing = 0.4 m is 1.3 times the ice's thickness") &&
                   Catch::Contains("leave it out for 0.21 m, or give at most 0.225 m"));
}

TEST_CASE("level ice deeper than the hull is named", "[level_ice][edge][errors]") {
    Case p = sheet_case(0.8, 20.0);
    p.level_ice.thickness = 1.0;
    p.level_ice.spacing = 0.7;
    CHECK_THAT(start_text(make_world(p)),
               Catch::Contains("level_ice.thickness = 1 m reaches 0.9 m below the water, and the "
                               "hull 0.8 m"));
}

TEST_CASE("gaps and cracks that leave no ice are refused", "[level_ice][edge][errors]") {
    Case p = sheet_case(0.8, 20.0);
    p.file = "case.cfg";
    p.level_ice.gap = 0.85;  // of cells of 0.994 m, less 0.52 thicknesses
    CHECK_THAT(error_text([&] { make_world(p); }),
               Catch::StartsWith("case.cfg: level_ice.gap: 0.85 m leave no ice") &&
                   Catch::Contains("give at most 0.838 m"));
    p.level_ice.gap = 0.83;
    CHECK(make_world(p).edge.has_sheet());
    p.level_ice.gap = 0.01;
    p.level_ice.length_factor = 0.05;  // cracks of 0.155 m
    CHECK_THAT(error_text([&] { make_world(p); }),
               Catch::Contains("level_ice: cracks 0.155 m from the load leave no piece"));
    p.level_ice.length_factor = 10.0;
    CHECK_THAT(error_text([&] { make_world(p); }),
               Catch::Contains("cracks 31.1 m from the load are longer than the sheet, which is 16 "
                               "m broad") &&
                   Catch::Contains("level_ice.length_factor"));
}

TEST_CASE("a ship deep in ice of which nothing broke off gets a warning",
          "[level_ice][edge][record]") {
    World w = wedge_at(-5.8);
    CHECK_FALSE(warn_of_whole_ice(w));
    w.scene.bodies.position[kShip].x() = -kStem + 0.5;
    CHECK_FALSE(warn_of_whole_ice(w));
    w.scene.bodies.position[kShip].x() = -kStem + 3.0;
    const auto warning = warn_of_whole_ice(w);
    REQUIRE(warning);
    CHECK(warning->affects_mean == true);
    CHECK_THAT(warning->text, Catch::StartsWith("no piece broke off, although the ship is 3 m deep "
                                                "in the level ice") &&
                                  Catch::Contains("bending.factor"));
}

TEST_CASE("a run in level ice is one from its start, without a piece",
          "[level_ice][edge][record]") {
    const World w = wedge_at(-5.8);
    CHECK(measure_ice(w.scene, w.parameters).hold ==
          std::vector<std::string>{"until-bent", "always"});
}

TEST_CASE("no time is foretold of level ice, whose first steps are idle", "[level_ice][edge]") {
    World w = wedge_at(-5.8);
    const std::string text = describe_cost(w);
    CHECK_THAT(text, Catch::StartsWith("  cost       1000 steps, the first ones of ") &&
                         Catch::Contains("those in the ice take many times as long\n") &&
                         !Catch::Contains("at least") && !Catch::Contains("memory"));
}
