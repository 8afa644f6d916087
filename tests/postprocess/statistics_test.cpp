// SPDX-License-Identifier: GPL-3.0-or-later
// Load map and bottom coverage: answers known beforehand, then what must hold for any run.
//
// Tolerances: 1e-12 and 1e-9 are rounding of sums over faces and contacts; 1 % is the cells along
// an edge.
#include <catch2/catch.hpp>
#include <numeric>
#include <random>

#include "postprocess/statistics/bottom_coverage.hpp"
#include "postprocess/statistics/choose_frames.hpp"
#include "postprocess/statistics/line_of_action.hpp"
#include "postprocess/statistics/load_map.hpp"
#include "postprocess/statistics/panel_map.hpp"
#include "tests/common/fixtures.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using namespace ice::test;
using namespace ice::statistics;

namespace {

double area_of(const TriangleMesh& mesh) {
    double area = 0.0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) area += mesh.area_vector(t).norm();
    return area;
}

// one contact per frame at a place of the box hull (x 0 to 8, y -1 to 1, z -0.7 to 0.5)
RunData run_with_contact(const Vec3& point, const Vec3& force, int dimension = 3) {
    RunData run = make_run({.dimension = dimension, .floes = 2, .frames = 11});
    // a hull of 56 m2 with 2000 spheres, 0.18 m apart: a radius of 0.27 m
    run.header.shapes[0].centers.assign(2000, Vec3::Zero());
    run.header.shapes[0].radii.assign(2000, 0.05);
    for (std::size_t f = 0; f < run.frames.size(); ++f) {
        run.frames[f].hull_contacts.clear();
        if (f > 0) run.frames[f].hull_contacts = {{1, 0, point, force, Vec3::Zero()}};
    }
    return run;
}

}  // namespace

TEST_CASE(
    "300 N in the middle of the bottom are 300 N on the map, on the bottom, within its radius",
    "[statistics][analytic]") {
    const Vec3 at(4.0, 0.0, -0.7);
    const LoadMap map = make_load_map(run_with_contact(at, Vec3(0, 0, 300)), 0.0);
    CHECK(map.force == Near(300.0).epsilon(1e-12));
    CHECK(map.from == 0.0);
    CHECK(map.to == Near(1.0));
    double peak = 0.0;
    for (std::size_t t = 0; t < map.load.size(); ++t) {
        if (map.load[t] == 0.0) continue;
        peak = std::max(peak, map.load[t]);
        const Vec3 c = (map.mesh.corner(t, 0) + map.mesh.corner(t, 1) + map.mesh.corner(t, 2)) / 3;
        CHECK((c - at).norm() < map.radius);
        CHECK(map.mesh.area_vector(t).z() < 0.0);
    }
    // the kernel's height in the middle of a plane is 3 / (pi radius^2); triangles as large as the
    // radius take their centres' values, hence half
    CHECK(peak == Near(300.0 * 3.0 / (3.14159265 * map.radius * map.radius)).epsilon(0.5));
}

TEST_CASE("the map is the mean over time: a second half without load halves it",
          "[statistics][analytic]") {
    RunData run = run_with_contact(Vec3(4, 0, -0.7), Vec3(0, 0, 300));
    for (std::size_t f = 6; f < 11; ++f) run.frames[f].hull_contacts.clear();
    CHECK(make_load_map(run, 0.0).force == Near(150.0));
    CHECK(make_load_map(run, 0.5).force == 0.0);
    CHECK(make_load_map(run, 0.25).from == Near(0.3));  // whole frames only
}

TEST_CASE("load times area is the mean force wherever floes press", "[statistics][property]") {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> part(0.0, 1.0);
    RunData run = run_with_contact(Vec3::Zero(), Vec3::Zero());
    double sum = 0.0;
    for (std::size_t f = 1; f < run.frames.size(); ++f)
        for (HullContact& c : run.frames[f].hull_contacts) {
            // some on edges and corners, some a little off the surface
            c.point = Vec3(8.0 * part(random), part(random) < 0.5 ? -1.02 : 0.99, -0.7);
            c.normal_force = Vec3(-part(random), 0.3, part(random)) * 100.0;
            sum += 0.1 * c.normal_force.norm();
        }
    const LoadMap map = make_load_map(run, 0.0);
    CHECK(map.force == Near(sum).epsilon(1e-9));
    CHECK(*std::min_element(map.load.begin(), map.load.end()) >= 0.0);
    CHECK(scale_end(map) > 0.0);
}

TEST_CASE("in 2D 300 N per metre on a hull 1 m broad are 300 N", "[statistics][analytic]") {
    const LoadMap map = make_load_map(run_with_contact(Vec3(4, 0, -0.7), Vec3(0, 0, 300), 2), 0.0);
    CHECK(map.force == Near(300.0));
    for (std::size_t t = 0; t < map.load.size(); ++t)
        if (map.load[t] > 0.0) CHECK(map.mesh.area_vector(t).z() < 0.0);
}

TEST_CASE("a run without contacts or without a hull has a map without load", "[statistics]") {
    RunData run = make_run({.floes = 0, .frames = 3});
    CHECK(make_load_map(run, 0.0).force == 0.0);
    CHECK(scale_end(make_load_map(run, 0.0)) == 0.0);
    run.header.shapes[0].mesh = {};
    CHECK(make_load_map(run, 0.0).mesh.triangles.empty());
    run.header.shapes.clear();
    CHECK(make_load_map(run, 0.0).load.empty());
}

TEST_CASE("refining keeps area, closedness and regions, and leaves no long edge",
          "[statistics][property]") {
    TriangleMesh box = make_box({8.0, 2.0, 1.2});
    box.region[3] = 1;
    box.region_names = {"hull", "bow"};
    const double region_area = box.area_vector(3).norm();
    const TriangleMesh fine = refine_mesh(box, 0.5, 100000);
    CHECK(area_of(fine) == Near(area_of(box)).epsilon(1e-12));
    Vec3 sum = Vec3::Zero();
    double bow = 0.0, longest = 0.0;
    for (std::size_t t = 0; t < fine.triangles.size(); ++t) {
        sum += fine.area_vector(t);
        if (fine.region[t] == 1) bow += fine.area_vector(t).norm();
        for (int k = 0; k < 3; ++k)
            longest = std::max(longest, (fine.corner(t, k) - fine.corner(t, (k + 1) % 3)).norm());
    }
    CHECK(sum.norm() < tolerance(1e-12) * area_of(box));  // closed
    // Euler's formula for a closed surface without handles: V - E + F = 2 with E = 3/2 F
    CHECK(2 * fine.vertices.size() == fine.triangles.size() + 4);
    CHECK(bow == Near(region_area));
    CHECK(longest <= 0.5);
    CHECK(refine_mesh(box, 0.01, 1000).triangles.size() <= 1000);
}

TEST_CASE("a floe of 1 x 0.8 m under a bottom of 16 m2 covers a twentieth",
          "[statistics][analytic]") {
    RunData run = make_run({.floes = 1, .frames = 2});
    for (RunFrame& frame : run.frames) {
        frame.ship_position = Vec3(2.0, 0.0, 0.0);
        frame.orientation[0] = Eigen::Quaterniond::Identity();
    }
    run.frames[0].position[0] = Vec3(6.0, 0.1, -0.85);
    run.frames[1].position[0] =
        Vec3(6.0, 1.1, -0.85);  // half of its 0.8 m, less 0.1, under the hull
    const BottomCoverage cover = measure_bottom_coverage(run, 100);
    REQUIRE(cover.share.size() == 2);
    CHECK(cover.area == Near(16.0).epsilon(0.01));
    // cells of 8 m / 300 along the floe's edge of 3.6 m: 0.6 % of the hull at most
    CHECK(cover.share[0] == Near(0.05).margin(0.006));
    CHECK(cover.share[1] == Near(0.05 * 0.3 / 0.8).margin(0.006));
    run.frames[0].state[0] = FloeState::absent;
    CHECK(measure_bottom_coverage(run, 100).share[0] == 0.0);
}

TEST_CASE(
    "ice on deck or beside the hull does not cover its bottom, a hull out of the water has none",
    "[statistics]") {
    RunData run = make_run({.floes = 1, .frames = 1});
    run.frames[0].position[0] = GENERATE(Vec3(4, 0, 0.7), Vec3(4, 1.6, -0.8), Vec3(30, 0, -0.8));
    CHECK(measure_bottom_coverage(run, 10).share == std::vector<double>{0.0});
    run.frames[0].ship_position.z() = 2.0;
    CHECK(measure_bottom_coverage(run, 10).share.empty());
}

TEST_CASE("chosen frames are evenly spread, with the first and the last", "[statistics]") {
    CHECK(choose_frames(0, 5).empty());
    CHECK(choose_frames(1, 5) == std::vector<std::size_t>{0});
    CHECK(choose_frames(3, 5) == std::vector<std::size_t>{0, 1, 2});
    CHECK(choose_frames(9, 5) == std::vector<std::size_t>{0, 2, 4, 6, 8});
    CHECK(choose_frames(1000, 0) == std::vector<std::size_t>{0, 999});
}

TEST_CASE("a constant force at a known place acts along the line through it",
          "[statistics][analytic]") {
    const Vec3 at(6.0, 0.5, -0.4), force(-900.0, 60.0, 250.0);
    RunData run = run_with_contact(at, Vec3(0, 0, 300));
    for (HistoryRow& row : run.history) {
        row.contact_force = 0.8 * force;
        row.friction_force = 0.2 * force;
        row.moment = at.cross(force);
    }
    const LineOfAction load = find_line_of_action(run, 0.0);
    CHECK((load.force - force).norm() < tolerance(1e-9));
    REQUIRE(load.center);
    CHECK((*load.center - at).norm() < tolerance(1e-12));
    REQUIRE(load.point);
    CHECK((*load.point - at).norm() < tolerance(1e-9));  // the centre lies on the line
    CHECK(std::abs(load.couple) < tolerance(1e-9) * load.moment.norm());
}

TEST_CASE("a couple about the force stays, one across it moves the point of attack",
          "[statistics][analytic]") {
    RunData run = run_with_contact(Vec3(6, 0, -0.5), Vec3(-100, 0, 0));
    for (HistoryRow& row : run.history) {
        row.contact_force = Vec3(-100.0, 0, 0);
        row.friction_force = Vec3::Zero();
        // about the centre of load: 30 N m about the force's line and 50 N m of yaw to starboard,
        // which is the force 0.5 m to starboard
        row.moment = Vec3(6, 0, -0.5).cross(Vec3(-100, 0, 0)) + Vec3(-30.0, 0.0, -50.0);
    }
    const LineOfAction load = find_line_of_action(run, 0.0);
    REQUIRE(load.point);
    CHECK((*load.point - Vec3(6.0, -0.5, -0.5)).norm() < tolerance(1e-12));
    CHECK(load.couple == Near(30.0));
    for (RunFrame& frame : run.frames) frame.hull_contacts.clear();
    CHECK_FALSE(find_line_of_action(run, 0.0).center);
    run.history.clear();
    CHECK_FALSE(find_line_of_action(run, 0.0).point);
    CHECK(find_line_of_action(run, 0.0).force.isZero(0.0));
}

TEST_CASE("the mean force is that of the rows from a time on, the row at that time among them",
          "[statistics][analytic]") {
    RunData run = run_with_contact(Vec3(6, 0, -0.5), Vec3(-100, 0, 0));
    run.history.resize(3);
    for (std::size_t k = 0; k < 3; ++k) {
        run.history[k].time = static_cast<double>(k);
        run.history[k].contact_force = Vec3(k == 0 ? 1.0 : k == 1 ? 2.0 : 4.0, 0, 0);
        run.history[k].friction_force = Vec3::Zero();
    }
    CHECK(find_line_of_action(run, 1.0).force.x() == Near(3.0));
}

TEST_CASE("a scale ends at the load of 99 % of the loaded area, rounded up to two digits",
          "[statistics][analytic]") {
    LoadMap map;
    map.mesh = make_box({1.0, 1.0, 1.0});
    map.load.assign(12, 0.0);
    CHECK(scale_end(map) == 0.0);
    map.load[3] = 1234.0;
    CHECK(scale_end(map) == Near(1300.0));
    map.load[3] = 0.0450;
    CHECK(scale_end(map) == Near(0.045));
}

TEST_CASE("every triangle has the largest pressure of the panel of its nearest sphere",
          "[statistics][analytic]") {
    RunData run = make_run();
    // two panels: spheres at the bow and at the stern
    run.header.shapes[0].centers = {Vec3(7.9, 0, 0), Vec3(0.1, 0, 0)};
    run.header.shapes[0].radii = {0.05, 0.05};
    run.panels.of_sphere = {0, 1};
    const TriangleMesh fine = refine_mesh(run.header.shapes[0].mesh, 0.5, 100000);
    const LoadMap map = make_panel_map(run, fine);
    REQUIRE(map.load.size() == fine.triangles.size());
    for (std::size_t t = 0; t < map.load.size(); ++t) {
        const double x = (fine.corner(t, 0) + fine.corner(t, 1) + fine.corner(t, 2)).x() / 3.0;
        CHECK(map.load[t] == Near(x > 4.0 ? 900.0 / 0.25 : 25.0 / 0.2));
    }
    run.panels = {};
    CHECK(make_panel_map(run, fine).load.empty());
}
