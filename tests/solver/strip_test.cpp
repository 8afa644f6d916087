// SPDX-License-Identifier: GPL-3.0-or-later
// Level ice in 2D: a strip that breaks off at its bending length under the load of a beam on water.
#include "solver/live_edge/strip.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "common/base/parallel.hpp"
#include "solver/bending/breaking_load.hpp"
#include "solver/loads/potential_energy.hpp"
#include "solver/record/recorder.hpp"
#include "solver/run/balance.hpp"
#include "solver/run/run.hpp"
#include "tests/common/fixtures.hpp"
#include "tests/support/compare_runs.hpp"
#include "tests/support/edge_checks.hpp"
#include "tests/support/make_filled_sets.hpp"
#include "tests/support/make_worlds.hpp"

using namespace ice;
using namespace ice::test;

namespace {

constexpr double kDeg = std::numbers::pi / 180.0;

// Ice 1 m thick as in the table of published values: it breaks 15.85 m from its tip under 12.8
// kN/m.
Case thick_case(double speed, double dt) {
    Case p;
    p.dimension = 2;
    p.time_step = dt;
    p.duration = 1e6;
    p.speed_table = {{0.0, speed}};
    p.contact.restitution = 0.1;
    p.contact.friction_ship_ice = 0.1;
    p.contact.crushing_pressure = 1e6;
    p.level_ice.thickness = 1.0;
    p.level_ice.extent = {0.0, 200.0, 0.0, 0.0};
    p.level_ice.spacing = 0.2;
    p.level_ice.scatter = 0.0;
    return p;
}

// A hull with a straight stem at the angle `slope` [rad] from the horizontal, which at the height
// `top` [m] is at x = 0 of its mesh.
SphereSet straight_stem(double slope, double depth, double top, double length, double radius,
                        double spacing) {
    const auto stem = [&](double z) { return (z - top) / std::tan(slope); };
    const double deck = top + 0.5 * depth;
    return fill_section({Vec3(stem(-depth) - length, 0, -depth), Vec3(stem(-depth), 0, -depth),
                         Vec3(stem(deck), 0, deck), Vec3(stem(-depth) - length, 0, deck)},
                        radius, spacing);
}

World make_world(const Case& p, const SphereSet& hull) {
    World w;
    w.parameters = p;
    w.scene = make_scene(build_shape(hull, false), p.hull_position, Vec3(p.ship_speed(0.0), 0, 0));
    w.edge.begin(w.scene, w.parameters);
    return w;
}

// A ship whose stem is 1 mm clear of ice 1 m thick at its upper face.
World stem_at_ice(const Case& p, double slope) {
    const double top = (1.0 - p.ice_density / p.water_density) * p.level_ice.thickness;
    Case clear = p;
    clear.hull_position = Vec3(-1e-3, 0, 0);
    return make_world(clear, straight_stem(slope, 3.0, top, 10.0, 0.3, 0.3));
}

// p A of the last step [N/m].
double crushing_force(const World& w) {
    double sum = 0.0;
    for (const Constraint& c : w.constraints)
        if (c.a == 0 && c.total_normal() > 0.0) sum += c.max_impulse / w.parameters.time_step;
    return sum;
}

// Soft ice 0.3 m thick, which breaks 3.4 m from its tip, before a raked ship 12 m long.
Case soft_case(double speed, double duration) {
    Case p;
    p.dimension = 2;
    p.time_step = 0.01;
    p.duration = duration;
    p.average_from = 0.5 * duration;
    p.speed_table = {{0.0, speed}};
    p.contact.restitution = 0.1;
    p.contact.crushing_pressure = 1e6;
    p.frames_every = 0.5;
    p.history_every = 0.1;
    lay_weak_ice(p, {0.0, 60.0, 0.0, 0.0}, 0.1);
    p.hull_position = Vec3(-0.02, 0, 0);
    p.resolved = "\n[simulation]\ndimension = 2\nduration = 1.2\n";
    return p;
}

World soft_world(const Case& p) {
    static const SphereSet ship = straight_stem(kDeg * 40.0, 2.0, 0.03, 10.0, 0.1, 0.1);
    return make_world(p, ship);
}

}  // namespace

TEST_CASE("a strip bears a beam's load and breaks at a beam's length",
          "[level_ice][strip][analytic]") {
    Case p = thick_case(0.1, 0.01);
    p.water_density = 1025.0;
    // h [m], E [Pa], load [kN/m], length [m] at 0.5 MPa
    const auto [thickness, modulus, load, length] = GENERATE(table<double, double, double, double>(
        {{1.0, 5e9, 12.8, 15.85}, {1.0, 2e9, 16.1, 12.60}, {0.5, 5e9, 5.4, 9.42}}));
    p.bending.elastic_modulus = modulus;
    const IcePlate plate = plate_of(thickness, p);
    const double weight = 1025.0 * 9.81;
    const double closed = 0.680 * 5e5 * std::pow(weight * std::pow(thickness, 5) / modulus, 0.25);
    CHECK(breaking_load(0.0, thickness, p) == Approx(closed).epsilon(1e-3));
    CHECK(1e-3 * breaking_load(0.0, thickness, p) == Approx(load).margin(0.05));
    CHECK(beam_breaking_length(plate) == Approx(length).margin(0.005));
    // the largest moment of the beam under a load at its end, by its slope on both sides
    const double lambda = std::pow(3.0 * weight / (modulus * std::pow(thickness, 3)), 0.25);
    const auto moment = [&](double x) { return std::exp(-lambda * x) * std::sin(lambda * x); };
    const double at = beam_breaking_length(plate), beside = 1e-3 * at;
    CHECK(moment(at) > moment(at - beside));
    CHECK(moment(at) > moment(at + beside));
    // ... which is the strength there
    CHECK(breaking_load(0.0, thickness, p) / lambda * moment(at) ==
          Approx(5e5 * thickness * thickness / 6.0).epsilon(1e-12));
}

TEST_CASE("a strip breaks in the step in which the stem's load reaches the beam's",
          "[level_ice][strip][step][analytic]") {
    const double slope = kDeg * GENERATE(30.0, 60.0);
    CAPTURE(slope / kDeg);
    const Case p = thick_case(1e-3, 0.01);
    World w = stem_at_ice(p, slope);
    const double bears = breaking_load(0.0, 1.0, p);
    const double down_share = std::cos(slope) - 0.1 * std::sin(slope);
    double before = 0.0, now = 0.0;
    while (w.edge.broken() == 0) {
        REQUIRE(now < bears);
        before = now;
        const Momenta momenta = momenta_of(w);
        step(w);
        REQUIRE(w.time < 60.0);
        if (w.edge.broken() > 0) break;
        REQUIRE_NOTHROW(require_balance(momenta, w));
        now = crushing_force(w) * down_share;
        const auto [normal, tangent] = ship_on_ice(w);
        REQUIRE(-normal.z() - tangent.z() == Approx(now).epsilon(1e-6).margin(1e-6));
        if (now < bears) continue;
        // the load is reached: free from the next step on
        CHECK(before > (1.0 - 1e-3) * bears);
        CHECK(now < (1.0 + 1e-3) * bears);
        // a straight edge cut by a slope: A = depth / cos; faces 0.1 mm apart count as touching
        const double depth = bears * std::cos(slope) / (1e6 * down_share);
        CHECK(w.time * 1e-3 - 1e-3 - 0.5 * p.level_ice.gap == Approx(depth).margin(2e-4));
        step(w);
        REQUIRE(w.edge.broken() == 1);
        break;
    }
    REQUIRE(w.edge.broken() == 1);
    const IcePiece piece = w.edge.pieces()[0];
    CHECK(piece.load == Approx(now).epsilon(1e-6));
    const double length = beam_breaking_length(plate_of(1.0, p));
    CHECK(piece.radius == Approx(length).epsilon(1e-12));
    CHECK(w.edge.sheet().area() == Approx(200.0 - length).epsilon(1e-9));
    CHECK(tip_of(w.edge.sheet()) == Approx(length).epsilon(1e-9));
}

TEST_CASE("pieces of a strip have a beam's length, scattered as a share of it",
          "[level_ice][strip][step]") {
    Case p = soft_case(1.0, 1e3);
    p.level_ice.scatter = 0.2;
    World w = soft_world(p);
    while (w.edge.broken() < 12) {
        step(w);
        REQUIRE(w.time < 60.0);
    }
    const double length = beam_breaking_length(plate_of(0.3, p));
    double shortest = 10.0, longest = 0.0;
    for (const IcePiece& piece : w.edge.pieces()) {
        shortest = std::min(shortest, piece.radius / length);
        longest = std::max(longest, piece.radius / length);
        REQUIRE(piece.load >= breaking_load(0.0, 0.3, p));
        // what the hull had crushed at the upper face is missing, and half a gap at both ends
        REQUIRE(strip_length(piece.outline) <= piece.radius - p.level_ice.gap + 1e-9);
        REQUIRE(strip_length(piece.outline) >= piece.radius - p.level_ice.gap - 0.3);
    }
    CHECK(shortest >= 0.8);
    CHECK(longest <= 1.2);
    CHECK(longest - shortest > 0.1);
}

TEST_CASE("a strip's ice is neither lost nor made, and pieces are born at rest beside all else",
          "[level_ice][strip][step]") {
    Case p = soft_case(1.0, 1e3);
    p.drift_velocity = {GENERATE(0.0, -0.3), 0.0};
    World w = soft_world(p);
    const double whole = 60.0;
    const std::size_t bodies = w.scene.bodies.size();
    std::size_t seen = 0;
    while (w.time < 25.0) {
        begin_step(w);  // pieces break off here
        REQUIRE(std::abs(sum_of(w.edge.areas()) - whole) <= 1e-9 * whole);
        REQUIRE(w.scene.bodies.size() == bodies);
        const Bodies& b = w.scene.bodies;
        const auto pieces = w.edge.pieces();
        const double tip = tip_of(w.edge.sheet());
        for (; seen < pieces.size(); ++seen) {
            const auto i = static_cast<std::size_t>(pieces[seen].body);
            CAPTURE(w.time, seen);
            REQUIRE(b.velocity[i].x() == Approx(p.drift_velocity[0]).margin(1e-15));
            REQUIRE(b.velocity[i].z() == 0.0);
            REQUIRE(b.angular_momentum[i].isZero(0.0));
            REQUIRE(b.mass[i] == Approx(900.0 * 0.3 * strip_length(pieces[seen].outline)));
            // afloat: a tenth of it is above the water
            REQUIRE(b.position[i].z() == Approx(-0.4 * 0.3).margin(1e-9));
            const double half = 0.5 * strip_length(pieces[seen].outline);
            const double drift = p.drift_velocity[0] * w.time;
            // the hull's front at the upper face is x = 0 of its mesh
            CHECK(b.position[i].x() - half >= b.position[kShip].x() + 0.5 * p.level_ice.gap - 1e-6);
            CHECK(b.position[i].x() + half - drift ==
                  Approx(tip - 0.5 * p.level_ice.gap).margin(1e-6));
        }
        step(w);
        for (std::size_t i = w.edge.first_body(); w.steps % 50 == 0 && i < b.size(); ++i) {
            REQUIRE(b.position[i].y() == 0.0);
            REQUIRE(b.orientation[i].x() == 0.0);
            REQUIRE(b.orientation[i].z() == 0.0);
        }
    }
    CAPTURE(seen);
    CHECK(seen > 5);
    CHECK(w.edge.areas().pieces > 0.9 * (whole - w.edge.areas().sheet));
}

TEST_CASE("a strip goes on from a checkpoint, and by any number of threads, with the same bits",
          "[level_ice][strip][checkpoint]") {
    const TempFolder folder;
    const Case p = soft_case(1.0, 9.0);
    World whole = soft_world(p);
    run(whole, {folder / "whole", "first"});
    REQUIRE(whole.edge.broken() > 1);
    for (const std::int64_t stop : {1, 400, 651}) {
        CAPTURE(stop);
        World first = soft_world(p);
        RunOptions options{folder / "parts", "first"};
        options.keep_going = [&](double, const World& now) { return now.steps < stop; };
        REQUIRE(run(first, options).status == "interrupted");
        World second = soft_world(p);
        SavedRun saved = read_checkpoint(folder / "parts" / "checkpoint.h5", second);
        options = {folder / "parts", "first"};
        options.saved = &saved;
        const int before = thread_count();
        set_thread_count(stop % 2 == 0 ? 1 : 3);
        run(second, options);
        set_thread_count(before);
        check_same_runs(folder / "whole", folder / "parts", p.track);
        REQUIRE(second.edge.broken() == whole.edge.broken());
        REQUIRE(second.edge.sheet().loops() == whole.edge.sheet().loops());
    }
}

TEST_CASE("a steep stem crushes a strip and never bends it", "[level_ice][strip][step][analytic]") {
    const double slope = kDeg * 80.0, friction = 0.2;  // tan(slope) > 1 / friction
    Case p = thick_case(0.1, 0.02);
    p.contact.friction_ship_ice = friction;
    p.level_ice.spacing = 0.05;
    World w = stem_at_ice(p, slope);
    double force = 0.0;
    std::int64_t steps = 0;
    while (w.time < 40.0) {  // 4 m
        step(w);
        REQUIRE(std::abs(sum_of(w.edge.areas()) - 200.0) <= 1e-9 * 200.0);
        if (w.time < 10.0) continue;
        const auto [normal, tangent] = ship_on_ice(w);
        force += normal.x() + tangent.x();
        ++steps;
    }
    CHECK(w.edge.broken() == 0);
    // the stem's foot is where the ice is gone, to what the sheet keeps of crushed ice
    CHECK(w.edge.areas().crushed == Approx(4.0 - 0.1 - 0.25).margin(0.3));
    // the whole thickness is crushed at a time, but for the wing of the lower corner's disc, which
    // leans away from the stem; that of the upper one is on the deck as well
    const double mean = force / static_cast<double>(steps), wing = 0.05 + 0.5 * 0.05;
    const double lean = std::sin(slope) + friction * std::cos(slope);
    const double met = (1.0 - wing) * std::sin(slope) + wing * std::cos(slope);
    CHECK(mean == Approx(1e6 * met * lean).epsilon(2e-3));
    CHECK(mean == Approx(1e6 / std::sin(slope) * lean).epsilon(0.1));
}

TEST_CASE("a long way through a strip takes no more memory than what is within reach",
          "[level_ice][strip][step]") {
    Case p = soft_case(3.0, 1e3);
    p.level_ice.extent[1] = 400.0;
    World w = soft_world(p);
    std::size_t recesses = 0;
    std::int64_t alive = 0;
    const auto look = [&](double until) {
        recesses = 0;
        alive = 0;
        while (w.time < until) {
            step(w);
            recesses = std::max(recesses, w.scene.crushed.displacement.size());
            alive = std::max(alive, w.edge.alive());
        }
    };
    look(30.0);
    const std::size_t recesses_then = recesses;
    const std::int64_t alive_then = alive;
    REQUIRE(w.edge.retired() > 0);
    look(60.0);
    CAPTURE(recesses, recesses_then, alive, alive_then, w.edge.broken());
    CHECK(static_cast<double>(recesses) < 2.0 * static_cast<double>(recesses_then));
    CHECK(static_cast<double>(alive) < 1.5 * static_cast<double>(alive_then));
    CHECK(std::abs(sum_of(w.edge.areas()) - 400.0) <= 1e-9 * 400.0);
    // slots that held a piece hold the edge now: the ledger knows that it does not spin
    const double missing = w.ledger.residual(potential_energy(w.scene, w.parameters));
    CHECK(std::abs(missing) < 1e-3 * w.ledger.ship_work);
}

TEST_CASE("what lies behind the bow of a ship within a strip is astern", "[level_ice][strip]") {
    Case p = soft_case(1.0, 1e3);
    p.hull_position.x() = 20.0;
    const World w = soft_world(p);
    const IceAreas areas = w.edge.areas();
    CHECK(areas.sheet == Approx(40.0).epsilon(1e-9));
    CHECK(areas.crushed + areas.astern == Approx(20.0).epsilon(1e-9));
    CHECK(tip_of(w.edge.sheet()) == Approx(20.0).epsilon(1e-9));
    CHECK(tiles_of(w.edge, w.scene.bodies).size() == 1);
}

TEST_CASE("the end of a strip breaks off as one piece", "[level_ice][strip][step]") {
    Case p = soft_case(1.0, 1e3);
    p.level_ice.extent[1] = 4.0;
    World w = soft_world(p);
    while (w.time < 12.0) step(w);
    CHECK(w.edge.broken() >= 1);
    CHECK(w.edge.areas().sheet == 0.0);
    CHECK(std::abs(sum_of(w.edge.areas()) - 4.0) <= 4e-9);
    CHECK(tiles_of(w.edge, w.scene.bodies).empty());
}

TEST_CASE("tiles and windows of a strip are its tip's", "[level_ice][strip]") {
    IceSheet sheet(strip_extent(0.0, 50.0), 0.5);
    const auto tile = [&] { return strip_tiles(sheet, 0.0, 4.0); };
    REQUIRE(tile().size() == 1);
    CHECK(tile()[0] == loop_of(strip_extent(0.0, 12.0)));
    sheet.take(loop_of({Vec2(-1, -1), Vec2(3.5, 1)}));
    CHECK(tile()[0] == loop_of(strip_extent(3.5, 12.0)));
    sheet.take(loop_of({Vec2(-1, -1), Vec2(41.0, 1)}));
    CHECK(tile()[0] == loop_of(strip_extent(41.0, 50.0)));
    sheet.take(loop_of({Vec2(-1, -1), Vec2(51.0, 1)}));
    CHECK(tile().empty());
    CHECK(std::isinf(tip_of(sheet)));
    const Vec2 push(1.0, 0.0);
    const std::vector<EdgeLoad> loads{{{3.0, 0}, 3.0, 1.0, 1.0, push},
                                      {{4.0, 0}, -1.0, 1.0, 1.0, push},
                                      {{9.0, 0}, 7.0, 1.0, 1.0, push}};
    const auto windows = tip_window(loads, 3.0, 4.0);
    REQUIRE(windows.size() == 1);
    CHECK(windows[0].down == 2.0);
    CHECK(windows[0].at == Vec2(3.0, 0.0));
    CHECK(tip_window({loads[1]}, 3.0, 4.0).empty());
    CHECK(strip_bodies(loop_of(strip_extent(1.0, 2.0)), 0.1, 0.95).empty());
    CHECK(strip_length(strip_bodies(loop_of(strip_extent(1.0, 2.0)), 0.1, 0.5)[0]) == Approx(0.9));
}
