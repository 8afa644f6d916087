// SPDX-License-Identifier: GPL-3.0-or-later
// Statistics, the empirical formula, and the forces a step reports.
//
// Tolerances: 0.1 % is a sum of parts worked by hand to three digits; 1e-12 is rounding of a
// formula; 1e-9 that of sums over contacts, of newtons.
#include <catch2/catch.hpp>
#include <cmath>

#include "common/base/units.hpp"
#include "common/formulas/lindqvist.hpp"
#include "solver/record/hull_contacts.hpp"
#include "solver/record/measure_hull_dimensions.hpp"
#include "solver/record/measure_step.hpp"
#include "solver/record/recorder.hpp"
#include "solver/record/run_statistics.hpp"
#include "solver/run/run.hpp"
#include "tests/common/fixtures.hpp"
#include "tests/support/make_worlds.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;
using ice::test::tolerance;

TEST_CASE("Lindqvist's submersion resistance of the paper's ship is 1.4 kN at 0.5 m/s",
          "[record][analytic]") {
    // L 10, B 2, T 1.44, h 0.3, mu 0.1, phi 35 and alpha 30 degrees, density difference 100:
    // potential part 597 N, friction 339 N, speed factor 1.47 (worked by hand from the formula)
    const HullDimensions hull{10.0, 2.0, 1.44, 35 * kDegree, 30 * kDegree};
    const IceConditions ice{0.3, 0.1, 900.0, 1000.0, 9.81, 0.5};
    CHECK(lindqvist_submersion(hull, ice) == Near(1381.0).epsilon(0.001));
    IceConditions smooth = ice;
    smooth.friction = smooth.speed = 0.0;
    CHECK(lindqvist_submersion(hull, smooth) ==
          Near(100 * 9.81 * 0.3 * 2 * 1.44 * (2 + 1.44) / (2 + 2 * 1.44)).epsilon(1e-12));
}

TEST_CASE("cos psi sqrt(1/sin^2 phi + 1/tan^2 alpha) is 1/tan phi: friction at rest is closed",
          "[record][analytic]") {
    const double phi = 28 * kDegree, alpha = 22 * kDegree;
    const HullDimensions hull{12.0, 3.0, 1.2, phi, alpha};
    const IceConditions a{0.3, 0.2, 900, 1000, 9.81, 0.0}, b{0.3, 0.0, 900, 1000, 9.81, 0.0};
    const double friction = lindqvist_submersion(hull, a) - lindqvist_submersion(hull, b);
    const double covered = 0.7 * 12.0 - 1.2 / std::tan(phi) - 3.0 / (4 * std::tan(alpha)) +
                           1.2 * std::cos(phi) / std::tan(phi);
    CHECK(friction == Near(100 * 9.81 * 0.3 * 3.0 * 0.2 * covered).epsilon(1e-12));
}

TEST_CASE("hull angles are measured from the mesh at the waterline", "[record][analytic]") {
    // a wedge: stem raked by 40 degrees, waterline half angle 25 degrees, 2 m broad, floor at -1
    const double rake = 1.0 / std::tan(40 * kDegree), run = 1.0 / std::tan(25 * kDegree);
    TriangleMesh mesh;
    const auto section = [&](double z) {
        const double x = 10.0 + z * rake;
        mesh.vertices.insert(mesh.vertices.end(),
                             {Vec3(x, 0, z), Vec3(x - run, 1, z), Vec3(-20, 1, z), Vec3(-20, -1, z),
                              Vec3(x - run, -1, z)});
    };
    section(-1.0);
    section(0.5);
    for (int k = 0; k < 5; ++k) {
        const int n = (k + 1) % 5;
        mesh.triangles.push_back({k, n, 5 + k});
        mesh.triangles.push_back({n, 5 + n, 5 + k});
    }
    const auto dimensions = measure_hull_dimensions(mesh, 0.0);
    REQUIRE(dimensions);
    CHECK(dimensions->length == Near(30.0));
    CHECK(dimensions->breadth == Near(2.0));
    CHECK(dimensions->draught == Near(1.0));
    CHECK(dimensions->stem_angle == Near(40 * kDegree));
    CHECK(dimensions->entrance_angle == Near(25 * kDegree));
    // full breadth counts from 0.99 B on, and the bow's planes end at B
    CHECK(dimensions->bow_length == Near(0.99 * run));
    CHECK(dimensions->parallel_length == Near(30.0 - 0.99 * run));
    CHECK_FALSE(measure_hull_dimensions(mesh, 5.0));
    // the same shape at any size
    for (Vec3& v : mesh.vertices) v *= 1e-5;
    const auto small = measure_hull_dimensions(mesh, 0.0);
    REQUIRE(small);
    CHECK(small->stem_angle == Near(40 * kDegree));
    CHECK(small->entrance_angle == Near(25 * kDegree));
}

TEST_CASE("forces are the opposite of what the floe feels, split into normal and friction",
          "[record]") {
    Case p = test::empty_space(0.01);
    p.speed_table = {{0.0, 1.0}};
    World w = test::plate_world(p, Vec3(4, 4, 0.4), 0.1, 0.1, 0.0);
    const auto box = test::add_shape(w, test::make_box_set(Vec3(1, 0.8, 0.3), 0.05, 0.1));
    const std::size_t i =
        add_floe(w.scene, box, 900.0, Vec3(0, 0, -0.151), Quaternion::Identity(), 0, false);
    w.scene.bodies.momentum[i] = w.scene.bodies.mass[i] * Vec3(0, 0, 0.5);
    update_derived(w.scene.bodies, i);
    const Vec3 before = w.scene.bodies.momentum[i];
    step(w);
    const StepRecord r = measure_step(w.scene, w.contacts, w.constraints, 0.01);
    const Vec3 change = w.scene.bodies.momentum[i] - before;
    CHECK((r.contact_force + r.friction_force + change / 0.01).norm() <
          tolerance(1e-9) * change.norm() / 0.01);
    CHECK(r.contact_force.z() > 0.0);   // ice from below lifts the ship
    CHECK(r.friction_force.x() < 0.0);  // and holds it back
    CHECK(r.friction_force.norm() <=
          tolerance(0.1) * r.contact_force.norm() * (1 + tolerance(1e-9)));
    REQUIRE(r.regions.size() == 1);
    CHECK(r.regions[0].floe == 1);
    CHECK((r.regions[0].impulse / 0.01 - r.contact_force - r.friction_force).norm() <
          tolerance(1e-9));
    CHECK((r.regions[0].friction / 0.01 - r.friction_force).norm() < tolerance(1e-9));
}

TEST_CASE("forces on chosen floes are the impulses of their contacts over the step",
          "[record][analytic]") {
    const auto touch = [](std::int32_t a, std::int32_t b, double push, double rub) {
        Constraint c;
        c.a = a;
        c.b = b;
        c.normal = -Vec3::UnitZ();
        c.rest_normal = push;
        c.rest_tangent = Vec3(rub, 0, 0);
        return c;
    };
    // the ship presses floe 1 down, which presses floe 2, which presses floe 3
    const std::vector<Constraint> contacts{touch(0, 1, 3.0, 0.5), touch(1, 2, 2.0, 0.25),
                                           touch(2, 3, 1.0, 0.0)};
    const std::vector<std::int32_t> entry_of{-1, 1, -1, 0};
    std::vector<FloeForces> forces(2, {Vec3::Ones(), Vec3::Ones(), Vec3::Ones()});
    measure_floe_forces(contacts, 0.5, entry_of, forces);
    CHECK(forces[0].contact == Vec3::Zero());
    CHECK(forces[0].ice == Vec3(0, 0, -2.0));
    CHECK(forces[1].contact == Vec3(0, 0, 6.0));
    CHECK(forces[1].friction == Vec3(-1.0, 0, 0));
    CHECK(forces[1].ice == Vec3(-0.5, 0, 4.0));
}

TEST_CASE("the forces on floes, in rows and in frames, are together those on the ship",
          "[record]") {
    Case p;
    p.time_step = 0.01;
    p.duration = 0.5;
    p.speed_table = {{0.0, 1.0}};
    p.frames_every = 0.1;
    p.history_every = 0.05;
    p.track = {2, 1};
    p.floes.resize(1);
    p.floes[0].hold = Hold::never;
    World w = test::plate_world(p, Vec3(3, 2, 0.4), 0.1, 0.2, -0.5);
    const auto box = test::add_shape(w, test::make_box_set(Vec3(0.5, 0.4, 0.2), 0.05, 0.1));
    add_floe(w.scene, box, 900.0, Vec3(0.0, 0.05, -0.601), Quaternion::Identity(), 0, false);
    add_floe(w.scene, box, 800.0, Vec3(0.7, 0.05, -0.601), Quaternion::Identity(), 0, false);
    const test::TempFolder folder;
    run(w, {folder / "run", "command"});
    const RunData data = read_run(folder / "run" / "run.h5");

    // rounding of a handful of sums; frames keep single precision
    const double kRows = 1e-12, kFrames = 1e-5;
    Vec3 by_rows[2] = {Vec3::Zero(), Vec3::Zero()};  // impulses on floes 1 and 2 [N s]
    double of_friction = 0.0;
    for (std::size_t k = 0; k < data.history.size(); ++k) {
        const HistoryRow& row = data.history[k];
        const TrackRow* const floe[2] = {&data.tracks[1][k], &data.tracks[0][k]};
        const Vec3 contact = floe[0]->contact_force + floe[1]->contact_force;
        const Vec3 friction = floe[0]->friction_force + floe[1]->friction_force;
        CHECK((contact - row.contact_force).norm() <= tolerance(kRows) * row.contact_force.norm());
        CHECK((friction - row.friction_force).norm() <=
              tolerance(kRows) * row.friction_force.norm());
        of_friction += 0.05 * row.friction_force.norm();
        for (int n = 0; n < 2; ++n)
            by_rows[n] -= 0.05 * (floe[n]->contact_force + floe[n]->friction_force);
    }
    CHECK(of_friction > 0.05 * (by_rows[0] + by_rows[1]).norm());
    CHECK((by_rows[0] - by_rows[1]).norm() >
          0.01 * by_rows[0].norm());  // or they could be mixed up
    for (std::size_t n = 0; n < 2; ++n) {
        Vec3 by_frames = Vec3::Zero();
        for (std::size_t k = 1; k < data.frames.size(); ++k)
            by_frames +=
                (data.frames[k].time - data.frames[k - 1].time) * data.frames[k].contact_force[n];
        CHECK((by_frames - by_rows[n]).norm() < tolerance(kFrames) * by_rows[n].norm());
    }
}

TEST_CASE("floes that do not exist or are named twice cannot be tracked", "[record][degenerate]") {
    Case p = test::empty_space(0.01);
    World w = test::plate_world(p, Vec3(3, 2, 0.4), 0.1, 0.2, -0.5);
    const auto box = test::add_shape(w, test::make_box_set(Vec3(0.5, 0.4, 0.2), 0.05, 0.1));
    add_floe(w.scene, box, 900.0, Vec3(0, 0, -2), Quaternion::Identity(), 0, false);
    p.track = {1};
    CHECK_NOTHROW(Recorder(p, w.scene));
    for (const std::vector<int>& track : {std::vector{0}, {2}, {-1}, {1, 1}}) {
        p.track = track;
        CHECK_THROWS_WITH(Recorder(p, w.scene), Catch::Contains("output.track"));
    }
}

TEST_CASE("hull contacts between two frames add up to the forces of their steps",
          "[record][property]") {
    Case p = test::empty_space(0.01);
    p.speed_table = {{0.0, 1.0}};
    World w = test::plate_world(p, Vec3(4, 4, 0.4), 0.1, 0.1, 0.0);
    const auto box = test::add_shape(w, test::make_box_set(Vec3(1, 0.8, 0.3), 0.05, 0.1));
    const std::size_t i =
        add_floe(w.scene, box, 900.0, Vec3(0, 0, -0.151), Quaternion::Identity(), 0, false);
    HullContacts contacts;
    Vec3 push = Vec3::Zero(), rub = Vec3::Zero();
    const int steps = 5;
    for (int k = 0; k < steps; ++k) {
        w.scene.bodies.momentum[i] = w.scene.bodies.mass[i] * Vec3(0, 0, 0.5);
        update_derived(w.scene.bodies, i);
        step(w);
        contacts.add(w.scene.bodies, w.contacts, w.constraints);
        const StepRecord r = measure_step(w.scene, w.contacts, w.constraints, 0.01);
        push += r.contact_force / steps;
        rub += r.friction_force / steps;
    }
    const auto found = contacts.take(steps * 0.01);
    REQUIRE(found.size() > 1);
    for (const HullContact& c : found) {
        push -= c.normal_force;
        rub -= c.friction_force;
        CHECK(c.floe == 1);
        // on the plate's lower face, in the frame of the ship that has moved on by 0.05 m
        CHECK(c.point.z() == Near(-0.2).margin(0.01));
        CHECK(std::abs(c.point.x() + 0.05) < 0.55);
    }
    CHECK(push.norm() < tolerance(1e-9));
    CHECK(rub.norm() < tolerance(1e-9));
    CHECK(contacts.take(1.0).empty());
}

TEST_CASE("a touch that lasts is one hit, a second touch another", "[record]") {
    RunStatistics statistics({{"hull", "bow"}, 0.0, true, 0.01});
    StepRecord touching, apart;
    touching.regions = {{3, 1, Vec3(-2, 0, 0), Vec3(-0.5, 0, 0)}};
    for (const StepRecord* r : {&touching, &touching, &apart, &touching})
        statistics.add(*r, 0.1, 0.1, true);
    Summary summary;
    statistics.fill(summary);
    CHECK(summary.regions["bow"].hits == 2);
    CHECK(summary.regions["bow"].max_impulse == 2.0);
    CHECK(summary.regions["bow"].mean[0] == Near(-6.0 / 0.4));
    CHECK(summary.regions["bow"].contact_mean[0] == Near(-4.5 / 0.4));
    CHECK(summary.regions["bow"].friction_mean[0] == Near(-1.5 / 0.4));
    CHECK(summary.regions["hull"].hits == 0);
}
