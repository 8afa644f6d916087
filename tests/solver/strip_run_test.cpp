// SPDX-License-Identifier: GPL-3.0-or-later
// Level ice in 2D while a ship goes through it: pieces, their sum, memory and restarts.
//
// Tolerances: 1e-9 of a length or an area is ends on whole multiples of 2^-30 m; 1e-15 is rounding
// of a speed; 1e-9 m is a height found by bisection.
#include <catch2/catch.hpp>
#include <cmath>

#include "common/base/parallel.hpp"
#include "solver/bending/breaking_load.hpp"
#include "solver/live_edge/edge_plan.hpp"
#include "solver/live_edge/strip.hpp"
#include "solver/loads/potential_energy.hpp"
#include "solver/record/recorder.hpp"
#include "solver/run/run.hpp"
#include "tests/common/fixtures.hpp"
#include "tests/support/compare_runs.hpp"
#include "tests/support/make_strips.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using namespace ice::test;

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
        REQUIRE(strip_length(piece.outline) <= piece.radius - p.level_ice.gap + tolerance(1e-9));
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
        REQUIRE(std::abs(sum_of(w.edge.areas()) - whole) <= tolerance(1e-9) * whole);
        REQUIRE(w.scene.bodies.size() == bodies);
        const Bodies& b = w.scene.bodies;
        const auto pieces = w.edge.pieces();
        const double tip = tip_of(w.edge.sheet());
        for (; seen < pieces.size(); ++seen) {
            const auto i = static_cast<std::size_t>(pieces[seen].body);
            CAPTURE(w.time, seen);
            REQUIRE(b.velocity[i].x() == Near(p.drift_velocity[0]).margin(1e-15));
            REQUIRE(b.velocity[i].z() == 0.0);
            REQUIRE(b.angular_momentum[i].isZero(0.0));
            REQUIRE(b.mass[i] == Near(900.0 * 0.3 * strip_length(pieces[seen].outline)));
            // afloat: a tenth of it is above the water
            REQUIRE(b.position[i].z() == Near(-0.4 * 0.3).margin(1e-9));
            const double half = 0.5 * strip_length(pieces[seen].outline);
            const double drift = p.drift_velocity[0] * w.time;
            // the hull's front at the upper face is x = 0 of its mesh
            CHECK(b.position[i].x() - half >=
                  b.position[kShip].x() + 0.5 * p.level_ice.gap - tolerance(1e-6));
            CHECK(b.position[i].x() + half - drift ==
                  Near(tip - 0.5 * p.level_ice.gap).margin(1e-6));
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

TEST_CASE("a long way through a strip takes no more memory than what is within reach",
          "[level_ice][strip][step]") {
    Case p = soft_case(3.0, 1e3);
    p.level_ice.extent[1] = 400.0;
    World w = soft_world(p);
    std::size_t recesses = 0;
    std::int64_t alive = 0;
    const auto run_until = [&](double until) {
        recesses = 0;
        alive = 0;
        while (w.time < until) {
            step(w);
            recesses = std::max(recesses, w.scene.crushed.displacement.size());
            alive = std::max(alive, w.edge.alive());
        }
    };
    run_until(30.0);
    const std::size_t recesses_then = recesses;
    const std::int64_t alive_then = alive;
    REQUIRE(w.edge.retired() > 0);
    run_until(60.0);
    CAPTURE(recesses, recesses_then, alive, alive_then, w.edge.broken());
    CHECK(static_cast<double>(recesses) < 2.0 * static_cast<double>(recesses_then));
    CHECK(static_cast<double>(alive) < 1.5 * static_cast<double>(alive_then));
    CHECK(std::abs(sum_of(w.edge.areas()) - 400.0) <= tolerance(1e-9) * 400.0);
    // slots that held a piece hold the edge now: the ledger knows that it does not spin
    const double missing = w.ledger.residual(potential_energy(w.scene, w.parameters));
    CHECK(std::abs(missing) < tolerance(1e-3) * w.ledger.ship_work);
}

TEST_CASE("what lies behind the bow of a ship within a strip is astern", "[level_ice][strip]") {
    Case p = soft_case(1.0, 1e3);
    p.hull_position.x() = 20.0;
    const World w = soft_world(p);
    const IceAreas areas = w.edge.areas();
    CHECK(areas.sheet == Near(40.0).epsilon(1e-9));
    CHECK(areas.crushed + areas.astern == Near(20.0).epsilon(1e-9));
    CHECK(tip_of(w.edge.sheet()) == Near(20.0).epsilon(1e-9));
    CHECK(tiles_of(w.edge, w.scene.bodies).size() == 1);
}

TEST_CASE("a gap that leaves nothing of a strip's shortest piece is refused",
          "[level_ice][strip][errors]") {
    Case p = soft_case(1.0, 1e3);
    p.level_ice.scatter = 0.2;
    // a piece is 0.8 breaking lengths long at least, and no shorter than the smallest piece
    const double shortest = 0.8 * soft_world(p).edge.radius();
    p.level_ice.gap = shortest - 1.01 * kSmallestPiece * p.level_ice.thickness;
    CHECK_NOTHROW(soft_world(p));
    p.level_ice.gap = shortest - 0.99 * kSmallestPiece * p.level_ice.thickness;
    CHECK_THROWS_WITH(soft_world(p), Catch::Matchers::Contains("level_ice.gap") &&
                                         Catch::Matchers::Contains("leave no ice"));
}

TEST_CASE("the end of a strip breaks off as one piece", "[level_ice][strip][step]") {
    Case p = soft_case(1.0, 1e3);
    p.level_ice.extent[1] = 4.0;
    World w = soft_world(p);
    while (w.time < 12.0) step(w);
    CHECK(w.edge.broken() >= 1);
    CHECK(w.edge.areas().sheet == 0.0);
    CHECK(std::abs(sum_of(w.edge.areas()) - 4.0) <= tolerance(4e-9));
    CHECK(tiles_of(w.edge, w.scene.bodies).empty());
}
