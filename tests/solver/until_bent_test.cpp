// SPDX-License-Identifier: GPL-3.0-or-later
// Ice that is held until it bends: a leaning plate presses a held piece down until it breaks off.
//
// Tolerances: 4 % is a row of spheres, 5 % the product of two such; 1e-12 is rounding of sums over
// the steps; 0.5 is half of a table's last digit.
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <string>

#include "common/base/parallel.hpp"
#include "common/base/units.hpp"
#include "solver/record/measure_step.hpp"
#include "solver/run/measure_imbalance.hpp"
#include "solver/run/run.hpp"
#include "tests/common/fixtures.hpp"
#include "tests/support/compare_runs.hpp"
#include "tests/support/make_worlds.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;

namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kPressure = 2e6;  // [Pa]
constexpr double kFriction = 0.1;
constexpr double kThickness = 1.0;
constexpr double kSpeed = 0.2;
constexpr double kBreadth = 1.0;  // of the contact [m]

// The set with its axes turned.
SphereSet turned(SphereSet set, const Mat3& turn) {
    for (Vec3& v : set.centers) v = turn * v;
    for (Vec3& v : set.normals) v = turn * v;
    for (CreaseNormal& c : set.creases) c.normal = turn * c.normal;
    for (Vec3& v : set.mesh.vertices) v = turn * v;
    set.solid = measure_mass(set.mesh);
    return set;
}

// A wide plate at the angle `slope` from the horizontal leans over the edge of a piece that is held
// until a load of `breaking_load`; the plate goes along x and touches it at once.
World leaning_plate(double slope, double breaking_load) {
    Case p = test::empty_space(0.01);
    p.contact.crushing_pressure = kPressure;
    p.contact.friction_ship_ice = kFriction;
    p.floes[0].hold = Hold::until_bent;
    p.speed_table = {{0.0, kSpeed}};
    World w;
    w.parameters = p;
    const double rake = 0.5 * std::numbers::pi - slope;
    const Mat3 turn = Eigen::AngleAxisd(rake, Vec3::UnitY()).toRotationMatrix();
    const Vec3 hull(0.4, 2.0, 6.0), floe(3.0, kBreadth, kThickness);
    // along x from the plate's middle to its front, at the height of the piece's upper face
    const double front = 0.5 * hull.x() / std::cos(rake) + 0.5 * floe.z() * std::tan(rake);
    w.scene = make_scene(build_shape(turned(test::make_box_set(hull, 0.1, 0.2), turn), false),
                         Vec3(-0.5 * floe.x() - front - 1e-3, 0, 0), Vec3(kSpeed, 0, 0));
    const auto shape = test::add_shape(w, test::make_box_set(floe, 0.05, 0.1));
    add_floe(w.scene, shape, 900.0, Vec3::Zero(), Quaternion::Identity(), 0, true);
    w.scene.bodies.breaking_load = {kInf, breaking_load};
    return w;
}

// p A of the last step [N], from the contacts' strengths.
double crushing_force(const World& w) {
    double sum = 0.0;
    for (const Constraint& c : w.constraints)
        if (c.total_normal() > 0.0) sum += c.max_impulse / w.parameters.time_step;
    return sum;
}

struct Push {
    double along, down;  // of the ship on the ice [N]
};
Push push_of(const World& w) {
    const auto [normal, tangent] = test::ship_on_ice(w);
    return {normal.x() + tangent.x(), -normal.z() - tangent.z()};
}

}  // namespace

TEST_CASE("a held piece breaks off in the step in which its load is reached",
          "[step][bending][analytic]") {
    const double slope = kDegree * GENERATE(30.0, 60.0, 70.0), load = 0.29e6;
    CAPTURE(slope / kDegree);
    World w = leaning_plate(slope, load);
    const double sine = std::sin(slope), cosine = std::cos(slope);
    const double down_share = cosine - kFriction * sine, along_share = sine + kFriction * cosine;
    Push before{0.0, 0.0}, now{0.0, 0.0};
    double work = 0.0;
    while (w.scene.bodies.held[1] == Bodies::kHeld) {
        before = now;
        const Momenta momenta = momenta_of(w);
        step(w);
        REQUIRE_NOTHROW(require_balance(momenta, w));
        now = push_of(w);
        const double normal = crushing_force(w);
        // the plate's normals are floats
        REQUIRE(now.along == Near(normal * along_share).epsilon(1e-6));
        REQUIRE(now.down == Near(normal * down_share).epsilon(1e-6));
        for (const Constraint& c : w.constraints) {
            if (c.total_normal() <= 0.0) continue;
            // with the contact's own normal to the last digits
            const double s = c.normal.x(), k = -c.normal.z();
            const Vec3 push = c.total_normal() * c.normal + c.total_tangent();
            REQUIRE(push.x() == Near(c.max_impulse * (s + kFriction * k)).epsilon(1e-9));
            REQUIRE(-push.z() == Near(c.max_impulse * (k - kFriction * s)).epsilon(1e-9));
        }
        work += now.along * kSpeed * w.parameters.time_step;
        REQUIRE(w.time < 10.0);
    }
    CHECK(before.down < load);
    CHECK(now.down >= load);
    // a straight edge cut by a slope: A = depth breadth / cos; the section is cut by spheres 0.1 m
    // apart, of which the outermost stand on the piece's corners
    const double depth = load * cosine / (kPressure * kBreadth * down_share);
    CHECK(w.time * kSpeed - 1e-3 == Near(depth).epsilon(0.04));
    // one step's growth, and a row of spheres that comes in at once
    CHECK(now.along == Near(load * along_share / down_share).epsilon(0.04));
    CHECK(before.along < load * along_share / down_share);
    // half the product of the two, with the errors of both
    CHECK(work == Near(0.5 * load * along_share / down_share * depth).epsilon(0.05));
    // all of it is entered as breaking
    CHECK(w.ledger.breaking == Near(work).epsilon(1e-12));
    CHECK(w.ledger.ship_work == Near(work).epsilon(1e-12));
    CHECK(w.ledger.crushing == 0.0);
    CHECK(w.ledger.friction == 0.0);
    CHECK(w.ledger.kinetic_change == 0.0);
    // it moves from the next step on, and is no ice held until it bends any more
    step(w);
    CHECK(w.scene.bodies.velocity[1].x() > 0.0);
    CHECK(measure_step(w.scene, w.contacts, w.constraints, 0.01).breaking_x == 0.0);
    CHECK(w.ledger.breaking == Near(work).epsilon(1e-12));
}

TEST_CASE("peak and work before breaking are those of the closed formulas", "[bending][analytic]") {
    // (27), which the test above compares with, in numbers: slope, peak [kN], work [kJ], at 0.29 MN
    const auto [degrees, peak, work] = GENERATE(table<double, double, double>(
        {{30.0, 208.0, 16.0}, {60.0, 643.0, 56.0}, {70.0, 1139.0, 114.0}}));
    const double slope = kDegree * degrees, load = 290.0;
    const double down = std::cos(slope) - kFriction * std::sin(slope);
    const double force = load * (std::sin(slope) + kFriction * std::cos(slope)) / down;
    const double depth = load * std::cos(slope) / (1e-3 * kPressure * kBreadth * down);
    CHECK(force == Near(peak).margin(0.5));
    CHECK(0.5 * force * depth == Near(work).margin(0.5));
}

TEST_CASE("a steep side never bends the ice: it crushes the whole thickness", "[step][bending]") {
    const double slope = kDegree * 80.0, load = 0.29e6;
    World w = leaning_plate(slope, load);
    const double through = kThickness / std::tan(slope) + 0.6;
    double most = 0.0, force = 0.0;
    int steps = 0;
    while (w.time * kSpeed < through) {
        step(w);
        REQUIRE(w.scene.bodies.held[1] == Bodies::kHeld);
        most = std::max(most, push_of(w).down);
        if (w.time * kSpeed < kThickness / std::tan(slope) + 0.2) continue;
        force += push_of(w).along;
        ++steps;
    }
    const double section = kThickness / std::sin(slope) * kBreadth;
    CHECK(most < load);
    // the lowest of ten rows of spheres, on an edge that leans away from the plate, is not met
    const double whole = kPressure * section * (std::sin(slope) + kFriction * std::cos(slope));
    CHECK(force / steps > 0.88 * whole);
    CHECK(force / steps < 1.01 * whole);
    CHECK(w.ledger.breaking == Near(w.ledger.ship_work).epsilon(1e-12));
}

TEST_CASE("a side whose friction outweighs its slope lifts the ice", "[step][bending]") {
    World w = leaning_plate(kDegree * 80.0, 1.0);  // any load would break it
    w.parameters.contact.friction_ship_ice = 0.2;  // tan 80 deg > 1 / 0.2
    for (int k = 0; k < 50; ++k) {
        step(w);
        REQUIRE(push_of(w).down <= 0.0);
        REQUIRE(w.scene.bodies.held[1] == Bodies::kHeld);
    }
    CHECK(push_of(w).along > 0.0);
}

TEST_CASE("the factor's table holds at the normal speed of hull and ice", "[step][bending]") {
    const double slope = kDegree * 45.0;
    World plain = leaning_plate(slope, 0.2e6), fast = leaning_plate(slope, 0.1e6);
    // twice the load at the speed at which the slope meets the ice
    fast.parameters.bending.factor_table = {{0.0, 1.0}, {2.0 * kSpeed * std::sin(slope), 3.0}};
    while (plain.scene.bodies.held[1] == Bodies::kHeld) {
        step(plain);
        step(fast);
    }
    CHECK(fast.scene.bodies.held[1] == Bodies::kBent);
    CHECK(plain.steps > 20);
}

namespace {

// A row of pieces of 3 m before a leaning plate, each 2 cm from the next, or farther.
World row_of_pieces(Hold hold, double breaking_load, double pitch = 3.02) {
    World w = leaning_plate(kDegree * 40.0, breaking_load);
    w.parameters.floes[0].hold = hold;
    w.parameters.speed_table = {{0.0, 2.0}};
    for (int k = 1; k < 4; ++k)
        add_floe(w.scene, 1, 900.0, Vec3(pitch * k, 0, 0), Quaternion::Identity(), 0, true);
    w.scene.bodies.breaking_load.assign(5, breaking_load);
    w.scene.bodies.breaking_load[0] = kInf;
    return w;
}

bool same_bits(const World& l, const World& r) {
    const Bodies &a = l.scene.bodies, &b = r.scene.bodies;
    return a.position == b.position && a.momentum == b.momentum &&
           a.angular_momentum == b.angular_momentum && a.held == b.held;
}

}  // namespace

TEST_CASE("ice without strength is released at the first touch", "[step][bending]") {
    // the hull's or any body's; far from each other the pieces are touched by the hull alone
    const auto [hold, pitch, released] = GENERATE(table<Hold, double, int>(
        {{Hold::until_contact, 3.02, 4}, {Hold::until_hull_contact, 6.0, 1}}));
    World bent = row_of_pieces(Hold::until_bent, 0.0, pitch);
    World touched = row_of_pieces(hold, 0.0, pitch);
    touched.scene.bodies.breaking_load.clear();
    for (int k = 0; k < 200; ++k) {
        step(bent);
        step(touched);
        REQUIRE(same_bits(bent, touched));
    }
    // the ship and the first pieces
    const std::vector<std::uint8_t>& held = bent.scene.bodies.held;
    CHECK(std::count(held.begin(), held.end(), 0) == 1 + released);
    CHECK(bent.ledger.breaking == 0.0);
}

TEST_CASE("a moving floe that lies on held ice bends it by its weight", "[step][bending]") {
    const double share = GENERATE(0.9, 1.1);  // of the weight that the held one bears
    Case p = test::empty_space(0.01);
    p.contact.crushing_pressure = kPressure;
    p.gravity = 9.81;
    p.floes.resize(2);
    p.floes[0].hold = Hold::never;
    p.floes[1].hold = Hold::until_bent;
    World w = test::plate_world(p, Vec3(1, 1, 1), 0.1, 0.2, 50.0);
    const auto box = test::add_shape(w, test::make_box_set(Vec3(1, 0.8, 0.3), 0.05, 0.1));
    add_floe(w.scene, box, 900.0, Vec3(0.1, 0, 0.3), Quaternion::Identity(), 0, false);
    add_floe(w.scene, box, 900.0, Vec3::Zero(), Quaternion::Identity(), 1, true);
    w.scene.bodies.breaking_load = {kInf, kInf, w.scene.bodies.mass[1] * 9.81 / share};
    for (int k = 0; k < 20; ++k) step(w);
    CHECK(w.scene.bodies.held[2] == (share < 1.0 ? 1 : 0));
    CHECK(w.ledger.breaking == 0.0);  // the ship is far away
}

TEST_CASE("the order of threads does not decide when ice breaks", "[step][bending][determinism]") {
    const int threads = thread_count();
    World one = row_of_pieces(Hold::until_bent, 0.15e6),
          many = row_of_pieces(Hold::until_bent, 0.15e6);
    for (int k = 0; k < 200; ++k) {
        set_thread_count(1);
        step(one);
        set_thread_count(5);
        step(many);
        set_thread_count(threads);
        REQUIRE(same_bits(one, many));
    }
    CHECK(one.scene.bodies.held[1] == 0);
    CHECK(one.ledger.breaking > 0.0);
    CHECK(one.ledger.breaking == many.ledger.breaking);
}

namespace {

Case row_case() {
    Case p = row_of_pieces(Hold::until_bent, 0.15e6).parameters;
    p.duration = 2.0;
    p.average_from = 0.05;
    p.frames_every = 0.5;
    p.history_every = 0.0;
    p.resolved = "\n[simulation]\nduration = 2.0\n";
    return p;
}

World row_world() {
    World w = row_of_pieces(Hold::until_bent, 0.15e6);
    w.parameters = row_case();
    return w;
}

}  // namespace

TEST_CASE("a run continued while its ice bends ends with the same bits and files",
          "[step][bending][checkpoint]") {
    World probe = row_world();
    while (probe.scene.bodies.held[1] == Bodies::kHeld) step(probe);
    // before the piece breaks off, in the step in which it does, and afterwards
    const std::int64_t stop = probe.steps + GENERATE(-2, 0, 1, 60);
    CAPTURE(stop);
    const test::TempFolder folder;
    World whole = row_world();
    run(whole, {folder / "whole", "first"});
    {
        World w = row_world();
        RunOptions options{folder / "parts", "first"};
        options.keep_going = [&](double, const World& now) { return now.steps < stop; };
        REQUIRE(run(w, options).status == "interrupted");
    }
    World w = row_world();
    SavedRun saved = read_checkpoint(folder / "parts" / "checkpoint.h5", w);
    RunOptions options{folder / "parts", "first"};
    options.saved = &saved;
    run(w, options);
    test::check_same_runs(folder / "whole", folder / "parts", {});
}

TEST_CASE("breaking and submersion add up to the resistance, and forces.csv has the breaking",
          "[step][bending][record]") {
    const test::TempFolder folder;
    World w = row_world();
    const Summary s = run(w, {folder / "run", "row"});
    REQUIRE(s.resistance.breaking_mean);
    CHECK(*s.resistance.breaking_mean > 0.0);
    CHECK(*s.resistance.submersion_mean > 0.0);
    CHECK(*s.resistance.breaking_mean + *s.resistance.submersion_mean == s.resistance.mean);
    CHECK_FALSE(s.lateral.breaking_mean);
    // work of that force over the whole run
    CHECK(s.energy.at("breaking_J") > 0.0);
    std::ifstream table(folder / "run" / "forces.csv");
    std::string line;
    std::getline(table, line);
    REQUIRE(line.ends_with(",breaking_fx_N"));
    double sum = 0.0, mean = 0.0;
    int rows = 0;
    while (std::getline(table, line)) {
        const double breaking = std::stod(line.substr(line.rfind(',') + 1));
        sum -= breaking * 2.0 * 0.01;
        if (std::stod(line) < 0.05 - 1e-9) continue;
        mean -= breaking;
        ++rows;
    }
    // nine digits of each row
    CHECK(sum == Near(s.energy.at("breaking_J")).epsilon(1e-7));
    CHECK(mean / rows == Near(*s.resistance.breaking_mean).epsilon(1e-7));
    const Summary back = read_summary(folder / "run" / "summary.json");
    CHECK(back.resistance.breaking_mean == s.resistance.breaking_mean);
    CHECK(back.resistance.submersion_mean == s.resistance.submersion_mean);
}
