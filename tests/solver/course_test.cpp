// SPDX-License-Identifier: GPL-3.0-or-later
// Where the hull lies, whether it meets the ice, and which channels are closed.
//
// Tolerances: 0.02 is twice kCell over the 20 m of the average; 1e-9 m is rounding of places of 10
// m, with a reserve.
#include <catch2/catch.hpp>

#include "solver/record/warn_of_open_end.hpp"
#include "solver/run/check_course.hpp"
#include "solver/run/describe_case.hpp"
#include "solver/scene/ice_extent.hpp"
#include "solver/scene/place_hull.hpp"
#include "tests/common/fixtures.hpp"
#include "tests/support/make_worlds.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using namespace ice::test;

namespace {

// A box of 10 x 2 x 3 m whose keel is at z = `keel` of the mesh.
TriangleMesh hull_mesh(double keel) {
    TriangleMesh mesh = make_box_mesh(Vec3(10, 2, 3));
    for (Vec3& v : mesh.vertices) v.z() += 1.5 + keel;
    return mesh;
}

std::string complaint_about(Case p, double keel) {
    p.file = "case.cfg";
    return error_text([&] { place_hull(p, hull_mesh(keel)); });
}

// A hull of 10 x 2 x 1 m, draught 0.5 m, bow at x = 5, and floes of 1 x 1 x 0.4 m.
World world_of(const std::vector<Vec3>& places, double speed = 1.0) {
    Case p = empty_space(0.01);
    p.file = "case.cfg";
    p.duration = 20.0;
    p.average_from = 8.0;
    p.speed_table = {{0.0, speed}};
    p.floes.resize(2);
    p.floes[1].hold = Hold::always;
    World w = plate_world(p, Vec3(10, 2, 1), 0.1, 0.2, -0.5);
    const auto row = add_shape(w, make_box_set(Vec3(1, 1, 0.4), 0.05, 0.1));
    for (const Vec3& place : places)
        add_floe(w.scene, row, 900.0, place, Quaternion::Identity(), 0, false);
    return w;
}

// Loose floes on the ship's way up to x = 5 + `length`.
World field_of(int length, double speed = 1.0) {
    std::vector<Vec3> places;
    for (int k = 0; k < length; ++k) places.emplace_back(6.0 + k, 0, -0.1);
    return world_of(places, speed);
}

void add_unbroken(World& w, const Vec3& place) {
    add_floe(w.scene, 1, 900.0, place, Quaternion::Identity(), 1, true);
}

std::string only_warning(const World& w) {
    const auto warnings = check_course(w);
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0].affects_mean == true);
    return warnings[0].text;
}

constexpr double kCell = 0.2;  // spacing of the hull's spheres: what distances are right to

}  // namespace

TEST_CASE("a draught places the keel that far below the water, wherever the mesh's origin is",
          "[scene][analytic]") {
    const double keel = GENERATE(0.0, -1.2, 40.0);
    Case p;
    p.hull_draught = 0.8;
    p.hull_position = Vec3(-3, 1, std::nan(""));
    const Vec3 place = place_hull(p, hull_mesh(keel));
    CHECK(place.head<2>() == Eigen::Vector2d(-3, 1));
    CHECK(place.z() + keel == Near(-0.8));
    // the same by z
    Case by_z;
    by_z.hull_position = place;
    CHECK(place_hull(by_z, hull_mesh(keel)) == place);
}

TEST_CASE("a hull that lies above or under the water is refused with the numbers",
          "[scene][errors]") {
    Case p;
    p.hull_draught = 0.0;
    CHECK_THAT(complaint_about(p, 0.0), Catch::Contains("case.cfg: hull.draught") &&
                                            Catch::Contains("lie above the water") &&
                                            Catch::Contains("3 m deep, from z = 0 to 3 m") &&
                                            Catch::Contains("between 0 and 3 m"));
    p.hull_draught = GENERATE(3.0, 5.0);
    CHECK_THAT(complaint_about(p, 0.0), Catch::Contains("wholly under water"));
    Case q;  // keel at z = 0, no height given
    q.hull_position = Vec3(-102, 0, 0);
    CHECK_THAT(complaint_about(q, 0.0),
               Catch::Contains("case.cfg: hull.position: z = 0 m gives a draught of 0 m") &&
                   Catch::Contains("give hull.draught in its place"));
    q.hull_position.z() = GENERATE(1.0, 1e-9);
    CHECK_THAT(complaint_about(q, 0.0), Catch::Contains("lie above the water"));
    q.hull_position.z() = -3.5;
    CHECK_THAT(complaint_about(q, 0.0), Catch::Contains("wholly under water"));
}

TEST_CASE("clearance is the way to the first ice that the hull's section meets",
          "[step][analytic]") {
    // beside the hull, below its keel and astern there is nothing to meet
    World w = world_of({Vec3(9, 0, -0.1), Vec3(7, 3, -0.1), Vec3(6.5, 0, -2), Vec3(-8, 0, -0.1)});
    CHECK(measure_course(w).clearance == Near(3.5).margin(kCell));
    CHECK(std::isinf(measure_course(w).clearance_fixed));
    CHECK(measure_course(w).travel == Near(20.0));
    CHECK(measure_course(w).meets_at == Near(3.5).margin(kCell));
    add_unbroken(w, Vec3(15.5, 0.9, -0.1));
    CHECK(measure_course(w).clearance_fixed == Near(10.0).margin(kCell));
    // astern: the ship goes against x
    w.parameters.speed_table = {{0.0, -2.0}};
    CHECK(measure_course(w).clearance == Near(2.5).margin(kCell));
}

TEST_CASE("a ship that meets no ice, or too late, is warned of with both distances", "[step]") {
    CHECK_THAT(only_warning(world_of({Vec3(7, 5, -0.1)})), Catch::Contains("no ice lies on the"));
    World w = world_of({Vec3(40.5, 0, -0.1)});
    CHECK_THAT(only_warning(w), Catch::Contains("never meets the ice: it moves 20 m") &&
                                    Catch::Contains("hull.position"));
    w.parameters.duration = 40.0;
    w.parameters.average_from = 20.0;
    const auto warnings = check_course(w);
    REQUIRE_FALSE(warnings.empty());
    CHECK_THAT(warnings[0].text, Catch::Contains("averaged from 20 s, but the ship meets the ice"));
    CHECK(*warnings[0].share == Near(0.75).margin(0.02));
}

TEST_CASE("a ship that leaves the ice while forces are averaged is warned of", "[step]") {
    CHECK(check_course(field_of(25)).empty());
    CHECK_THAT(only_warning(field_of(5)),
               Catch::Contains("leaves the ice at 5.5 s, before forces are averaged from 8 s"));
    const World w = field_of(13);  // the bow is out at 13.5 s of 8 to 20 s
    CHECK_THAT(only_warning(w), Catch::Contains("the bow leaves the ice at 13.5 s"));
    CHECK(*check_course(w)[0].share == Near(6.5 / 12.0));
}

TEST_CASE("a ship that runs into unbroken ice is warned of", "[step]") {
    World w = field_of(25);
    add_unbroken(w, Vec3(22.5, 0.5, -0.6));
    CHECK_THAT(only_warning(w), Catch::Contains("runs into unbroken ice"));
    w.parameters.duration = 15.0;
    CHECK(check_course(w).empty());
}

TEST_CASE("the way to the ice begins at the stem, which no sphere reaches where it is sharp",
          "[step][analytic]") {
    World w = field_of(25);
    REQUIRE(measure_course(w).clearance == Near(0.5).margin(1e-9));
    for (Vec3& v : w.scene.shapes[0].mesh.vertices)
        if (v.x() > 0.0) v = Vec3(5.4, 0, v.z());  // a wedge's edge, 0.4 m before the spheres
    CHECK(measure_course(w).clearance == Near(0.1).margin(1e-9));
}

TEST_CASE("averages over less than a length are warned of, with the duration for one", "[step]") {
    World w = field_of(25);
    CHECK_FALSE(warn_of_short_averages(w));  // 12 m of a ship of 10 m
    w.parameters.average_from = 10.0;
    CHECK_FALSE(warn_of_short_averages(w));
    for (const auto& [from, words] :
         {std::pair(10.1, "averaged over 0.99 ship lengths, less than one: floes need about one"),
          std::pair(16.0, "duration = 26 with output.average_from = 16 makes it one")}) {
        w.parameters.average_from = from;
        const auto warning = warn_of_short_averages(w);
        REQUIRE(warning);
        CHECK_THAT(warning->text, Catch::Contains(words));
        CHECK_FALSE(warning->affects_mean);  // known after the run
    }
    CHECK(check_course(w).empty());
}

TEST_CASE("a ship at rest among ice and water at rest is warned of with its key", "[step]") {
    World w = world_of({Vec3(40, 0, -0.1)}, 0.0);
    CHECK(only_warning(w) ==
          "hull.speed = 0 and no ice drifts: the ship meets no ice; give hull.speed or "
          "ice.drift_velocity");
    CHECK_FALSE(check_course(w)[0].share);  // of a mean of zero
    CHECK_FALSE(warn_of_short_averages(w));
    w.parameters.current = {-1.0, 0.0};  // brings the ice
    CHECK(check_course(w).empty());
    w.parameters.current = {0.0, 0.0};
    w.parameters.speed_table = {{0.0, 1.0}, {10.0, 0.0}, {20.0, -1.0}};  // there and back
    CHECK(check_course(w).empty());
}

TEST_CASE("a ship that goes astern from the ice is warned of with the sign", "[step]") {
    const World w = world_of({Vec3(9, 0, -0.1)}, -0.5);
    CHECK_THAT(only_warning(w),
               Catch::Contains("the ship moves astern, 10 m at -0.5 m/s, and no ice lies") &&
                   Catch::Contains("give hull.speed without the minus sign"));
    CHECK_FALSE(check_course(w)[0].share);
    // ice behind it is on its course
    CHECK_THAT(only_warning(world_of({Vec3(-40, 0, -0.1)}, -0.5)),
               Catch::Contains("never meets the ice"));
}

TEST_CASE("nothing is said of floes that drift", "[step]") {
    World w = world_of({Vec3(40, 0, -0.1)});
    w.parameters.average_from = 16.0;
    w.scene.bodies.velocity[1] = Vec3(-1, 0, 0);
    CHECK(check_course(w).empty());
    CHECK_FALSE(warn_of_short_averages(w));
}

TEST_CASE("a channel has unbroken ice on both sides, and may have it ahead", "[scene]") {
    World w = field_of(10);
    const auto found = [&] { return find_ice_at_start(w.scene, w.parameters); };
    CHECK(found().loose.min().isApprox(Eigen::Vector2d(5.5, -0.5)));
    CHECK(found().loose.max().isApprox(Eigen::Vector2d(15.5, 0.5)));
    add_unbroken(w, Vec3(10, 1.2, -0.1));
    CHECK_FALSE(found().walls);
    add_unbroken(w, Vec3(10, -1.2, -0.1));
    CHECK(found().walls);
    CHECK_FALSE(found().closed);
    add_unbroken(w, Vec3(16.2, 0, -0.1));
    CHECK(found().closed);
}

TEST_CASE("floes pushed out of a channel's open end are warned of, with count and distance",
          "[record]") {
    World w = field_of(10);
    for (const double y : {-1.2, 1.2}) add_unbroken(w, Vec3(10, y, -0.1));
    list_moving(w.scene.bodies);
    w.scene.start = find_ice_at_start(w.scene, w.parameters);
    CHECK_FALSE(warn_of_open_end(w.scene, w.parameters, 10.0));
    w.scene.bodies.position[10].x() += 0.09;  // settled: less than a tenth of a floe
    CHECK_FALSE(warn_of_open_end(w.scene, w.parameters, 10.0));
    w.scene.bodies.position[10].x() += 2.0;
    w.scene.bodies.position[9].x() += 1.5;
    const auto warning = warn_of_open_end(w.scene, w.parameters, 10.0);
    REQUIRE(warning);
    CHECK(warning->affects_mean == true);
    CHECK_THAT(warning->text,
               Catch::Contains("pushed 2 floes out") &&
                   Catch::Contains("x = 15.5 m, the farthest by 2.09 m while it moved 10 m") &&
                   Catch::Contains("edges.ahead"));
    CHECK_FALSE(warn_of_open_end(w.scene, w.parameters, 30.0));  // they only spread
    // behind the bow they have only let the ship pass
    w.scene.bodies.position[kShip].x() += 15.0;
    CHECK_FALSE(warn_of_open_end(w.scene, w.parameters, 10.0));
    w.scene.bodies.position[kShip].x() -= 15.0;
    w.scene.start.closed = true;
    CHECK_FALSE(warn_of_open_end(w.scene, w.parameters, 10.0));
    w.scene.start.closed = w.scene.start.walls = false;
    CHECK_FALSE(warn_of_open_end(w.scene, w.parameters, 10.0));
}

TEST_CASE("a case described names draught, displacement, travel, clearance and spheres", "[step]") {
    World w = field_of(25);
    w.parameters.contact.crushing_pressure = 1e6;
    const std::string text = describe_case(w);
    CHECK_THAT(text, Catch::Contains("10 m long, 2 m broad, draught 0.5 m of 1 m depth") &&
                         Catch::Contains("displacement 10 t, no stem angle: its forward end is "
                                         "blunt\n") &&
                         Catch::Contains("25 floes of 1.13 to 1.13 m, 0.4 m thick") &&
                         Catch::Contains("held: never") &&
                         Catch::Contains("20 m, 2.00 ship lengths, in 2000 steps of 0.01 s") &&
                         Catch::Contains("averaged over 1.20 ship lengths, from 8 s") &&
                         Catch::Contains("none to unbroken ice") &&
                         Catch::Contains("hull 0.1 m, 0.2 m apart; ice 0.05 m, 0.1 m apart") &&
                         Catch::Contains("crushing 1 MPa"));
}

TEST_CASE("averages of less than a ship's length say so in words, of a length or more do not",
          "[step][analytic]") {
    World w = field_of(25);  // 1 m/s for 20 s, a ship of 10 m
    const auto [from, words, less] = GENERATE(
        table<double, const char*, bool>({{8.0, "1.20 ship lengths", false},
                                          {10.0, "1.00 ship lengths", false},
                                          {13.7, "0.63 ship lengths, less than one", true}}));
    w.parameters.average_from = from;
    CHECK(check_course(w).empty());
    Summary s;
    s.travel.averaged_lengths = (20.0 - from) / 10.0;
    for (const std::string& text : {describe_case(w), describe_rules(s)}) {
        CHECK_THAT(text, Catch::Contains(std::string("averaged over ") + words));
        CHECK((text.find("less than one") != std::string::npos) == less);
    }
}
