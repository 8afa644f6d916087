// SPDX-License-Identifier: GPL-3.0-or-later
// Level ice whose edge breaks where and when it is loaded: a small icebreaker goes into a sheet.
//
// Tolerances: 1e-9 of an area is outlines on whole multiples of 2^-30 m; 1e-6 m2 is 1 nm along a
// piece's outline; 1e-12 is rounding of one sum.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "common/base/parallel.hpp"
#include "common/formats/checkpoint_file.hpp"
#include "solver/live_edge/describe_edge.hpp"
#include "solver/live_edge/edge_tiles.hpp"
#include "solver/live_edge/edge_window.hpp"
#include "solver/record/recorder.hpp"
#include "solver/record/solid_overlap.hpp"
#include "solver/run/run.hpp"
#include "solver/scene/set_added_mass.hpp"
#include "tests/common/fixtures.hpp"
#include "tests/support/compare_runs.hpp"
#include "tests/support/edge_checks.hpp"
#include "tests/support/make_worlds.hpp"
#include "tests/support/small_icebreaker.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using namespace ice::test;

namespace {

constexpr double kPi = std::numbers::pi;
using Box = Eigen::AlignedBox2d;

}  // namespace

TEST_CASE("tiles of a straight edge are its cells and those behind",
          "[live_edge][level_ice][edge]") {
    const IceSheet sheet(Box(Vec2(0, -10), Vec2(30, 10)), 0.5);
    const auto any = [](const Loop&) { return true; };
    // x of -4 to 2: the cells at the edge; those behind have whole ones all around from x = 2 on
    const auto tiles =
        edge_tiles(sheet, {Vec2(0, -10), 2.0}, Box(Vec2(-3, -3), Vec2(9, 3)), {}, any);
    double area = 0.0;
    for (const Loop& tile : tiles) {
        area += area_of(tile);
        REQUIRE(tile[0].x() == 0.0);
    }
    CHECK(tiles.size() == 4);
    CHECK(area == Near(16.0));
}

TEST_CASE("unbroken ice above a floe has tiles, too", "[live_edge][level_ice][edge]") {
    const IceSheet sheet(Box(Vec2(0, -10), Vec2(30, 10)), 0.5);
    const auto any = [](const Loop&) { return true; };
    // the cells of 2 m from (8, -6) to (12, -2), beside those at the edge; one floe out of reach
    const std::vector<Box> floes{{Vec2(8.5, -5.5), Vec2(11.5, -2.5)}, {Vec2(90, 0), Vec2(95, 5)}};
    const auto tiles =
        edge_tiles(sheet, {Vec2(0, -10), 2.0}, Box(Vec2(-3, -7), Vec2(15, 3)), floes, any);
    double area = 0.0;
    std::size_t at_edge = 0;
    for (const Loop& tile : tiles) {
        at_edge += tile[0].x() == 0.0;
        if (tile[0].x() > 0.0) area += area_of(tile);
        CHECK((tile[0].x() == 0.0 || (tile[0].x() >= 8.0 && tile[0].x() <= 10.0)));
    }
    CHECK(at_edge == 6);
    CHECK(area == Near(16.0));
}

TEST_CASE("a strip that the grid cuts off goes to the cell beside it",
          "[live_edge][level_ice][edge]") {
    const IceSheet sheet(Box(Vec2(-0.1, -10), Vec2(30, 10)), 0.05);
    const auto broad = [](const Loop& l) { return area_of(l) > 0.5; };
    const Box reach(Vec2(-3, -2.9), Vec2(1, 2.9));
    const auto tiles = edge_tiles(sheet, {Vec2(0, -10), 2.0}, reach, {}, broad);
    double area = 0.0;
    for (const Loop& tile : tiles) {
        area += area_of(tile);
        REQUIRE(area_of(tile) == Near(2.1 * 2.0));
    }
    CHECK(area == Near(2.1 * 8.0));
}

TEST_CASE("loads on one piece are one window, the heaviest first",
          "[live_edge][level_ice][edge][analytic]") {
    const Vec2 along(3, 4);
    const std::vector<EdgeLoad> loads{{{0, 0}, 1.0, 2.0, 2.0, along},
                                      {{1, 0}, 3.0, 2.0, 4.0, along},
                                      {{9, 0}, 5.0, 1.0, 3.0, Vec2(0, -0.5)},
                                      {{9.5, 0}, -2.0, 1.0, 3.0, Vec2(0, -0.5)},
                                      {{20, 0}, -1.0, 1.0, 1.0, along}};
    const auto windows = edge_windows(loads, 2.0);
    REQUIRE(windows.size() == 2);
    CHECK(windows[0].down == 4.0);
    CHECK(windows[0].at.x() == Near(0.75));
    CHECK(windows[0].inwards.x() == Near(0.6));
    CHECK(windows[0].closing == Near(6.0 / 4.0));
    CHECK(windows[0].normal_speed == Near(6.0 / 10.0));
    CHECK(windows[1].down == 3.0);
    CHECK(windows[1].at.x() == 9.0);
    CHECK(edge_windows({}, 2.0).empty());
}

TEST_CASE("a ship breaks its way, ice is neither lost nor made, and no piece is born in another",
          "[live_edge][level_ice][edge][step]") {
    World w = make_world(sheet_case(0.8, 1e3));
    const double whole = 40.0 * 16.0;
    const std::size_t bodies = w.scene.bodies.size();
    REQUIRE(sum_of(w.edge.areas()) == Near(whole).epsilon(1e-12));
    std::size_t seen = 0;
    double deepest = 0.0;
    while (w.time < 10.0) {
        step(w);
        REQUIRE(std::abs(sum_of(w.edge.areas()) - whole) <= tolerance(1e-9) * whole);
        REQUIRE(w.scene.bodies.size() == bodies);
        const auto& pieces = w.edge.pieces();
        for (; seen < pieces.size(); ++seen) {
            const IcePiece& piece = pieces[seen];
            REQUIRE(w.edge.sheet().area_in(piece.outline) <= tolerance(1e-6));
            REQUIRE(area_of(piece.outline) >= 0.15 * 0.15);
            REQUIRE(piece.load > 0.0);
            deepest = std::max(deepest, measure_overlap(w.scene, 0, piece.body).depth);
            // a step after its birth
            REQUIRE(w.scene.bodies.velocity[static_cast<std::size_t>(piece.body)].norm() < 2.0);
        }
    }
    CAPTURE(seen, w.edge.areas().crushed, w.edge.areas().brash, deepest);
    CHECK(seen > 15);
    CHECK(w.edge.areas().brash < 0.1 * w.edge.areas().pieces);
    // a step's way of the ship, and how far the hull's convex outlines stand for it
    CHECK(deepest < 0.02);
}

TEST_CASE("the summary has the means of cracks and channel that the console prints",
          "[live_edge][level_ice][edge]") {
    const TempFolder folder;
    World w = make_world(sheet_case(0.8, 4.0));
    CHECK_FALSE(measure_cracks(w.edge));  // nothing broke off yet
    const Summary summary = run(w, {folder / "run", "first"});
    const auto pieces = w.edge.pieces();
    REQUIRE(pieces.size() > 3);
    double radius = 0.0;
    for (const IcePiece& piece : pieces)
        radius += piece.radius / static_cast<double>(pieces.size());
    REQUIRE(summary.cracks);
    CHECK(summary.cracks->pieces == static_cast<double>(pieces.size()));
    CHECK(summary.cracks->radius == Near(radius));
    CHECK(summary.cracks->per_length() == Near(radius / w.edge.length()));
    CHECK(summary.cracks->per_thickness() == Near(radius / w.edge.thickness()));
    CHECK(summary.cracks->opening_deg > 0.0);
    // the broken ice over the length along which it broke
    Eigen::AlignedBox2d broken;
    for (const IcePiece& piece : pieces)
        for (const Vec2& p : piece.outline) broken.extend(p);
    const IceAreas areas = w.edge.areas();
    CHECK(summary.cracks->channel_breadth * broken.sizes().x() ==
          Near(areas.pieces + areas.crushed + areas.brash));
    CHECK_THAT(describe_edge(w.edge),
               Catch::Contains(fmt::format("{:.2g} characteristic lengths (ships: 0.1 to 0.4), "
                                           "{:.2g} thicknesses (3 to 10)",
                                           summary.cracks->per_length(),
                                           summary.cracks->per_thickness())));
    CHECK(summary.ice.bending_model == "wedge");
    CHECK(summary.ice.bending_factor == w.parameters.bending.factor);
}

TEST_CASE("an area that is the rounding of a sum is described as none", "[live_edge]") {
    const IceAreas rounded = without_rounding({900.0, 80.0, 20.0, -7.11e-15, 0.0});
    CHECK(rounded.brash == 0.0);
    CHECK(rounded.crushed == 20.0);
    CHECK(without_rounding({900.0, 80.0, 1e-8, 2e-6, 0.0}).crushed == 0.0);
    CHECK(without_rounding({900.0, 80.0, 1e-8, 2e-6, 0.0}).brash == 2e-6);
    // a fault of the ledger is no rounding
    CHECK(without_rounding({900.0, 80.0, 20.0, -0.1, 0.0}).brash == -0.1);
}

TEST_CASE("new ice at the edge is crushed as deep as the ice before it",
          "[live_edge][level_ice][edge][step]") {
    World w = make_world(sheet_case(0.8, 1e3));
    // the deepest overlap of a piece with tiles or pieces, the hull left out
    const auto deepest = [&](const std::vector<std::int32_t>& bodies) {
        double most = 0.0;
        for (std::size_t i = w.edge.first_body(); i < w.scene.bodies.size(); ++i)
            for (const std::int32_t k : bodies) {
                const auto a = static_cast<std::int32_t>(i);
                const bool held = w.scene.bodies.held[i] && w.scene.bodies.held[std::size_t(k)];
                if (a != k && !held) most = std::max(most, measure_overlap(w.scene, a, k).depth);
            }
        return most;
    };
    std::size_t renewals = 0;
    while (w.time < 10.0) {
        // the overlaps of the step before: bodies that the next renewal may change are all
        std::vector<std::int32_t> all;
        for (std::size_t i = w.edge.first_body(); i < w.scene.bodies.size(); ++i)
            all.push_back(static_cast<std::int32_t>(i));
        const bool due = w.edge.is_due(w.scene);
        const double then = due ? deepest(all) : 0.0;
        step(w);
        if (!due || w.edge.changed().empty()) continue;
        ++renewals;
        CAPTURE(w.time, then);
        // A step's way of the ship, 16 mm, and the difference of new spheres from the old ones: a
        // notch ends between two spheres. The largest is 21 mm, of a corner crushed by 37 mm.
        CHECK(deepest(w.edge.changed()) < then + 0.025);
    }
    CHECK(renewals > 15);
}

TEST_CASE("neighbour lists that outlive a renewal of the edge give the contacts of new ones",
          "[live_edge][level_ice][edge][step]") {
    Case p = sheet_case(0.8, 1e3);
    p.drift_velocity = {GENERATE(0.0, -0.2), 0.0};
    World keeps = make_world(p), forgets = make_world(p);
    std::size_t renewals = 0, kept = 0;
    while (keeps.time < 6.0) {
        const auto tiles = tiles_of(keeps.edge, keeps.scene.bodies);
        step(keeps);
        forgets.motion = {};
        forgets.pairs = {};
        forgets.finder = {};
        step(forgets);
        CAPTURE(keeps.time);
        REQUIRE(state_hash(keeps.scene, keeps.constraints) ==
                state_hash(forgets.scene, forgets.constraints));
        REQUIRE(keeps.contacts.size() == forgets.contacts.size());
        if (keeps.edge.changed().empty()) continue;
        ++renewals;
        kept += tiles.size() > keeps.edge.changed().size() ? 1 : 0;
    }
    CHECK(keeps.edge.pieces().size() > 5);
    CHECK(renewals > 5);
    CHECK(kept > 0);  // some bodies stayed as they were
}

TEST_CASE("level ice that drifts past a ship is a ship that goes through level ice",
          "[live_edge][level_ice][edge][drift]") {
    const bool free = GENERATE(false, true);
    Case p = sheet_case(0.8, 1e3);
    p.ship.free[surge] = free;
    p.ship.mass = 30000.0;
    p.tow = {Vec3::Zero(), free ? 1e5 : 0.0, 0.0};
    World goes = make_world(p);
    p.speed_table = {{0.0, 0.0}};
    p.drift_velocity = {-0.8, 0.0};
    World rests = make_world(p);
    rests.scene.water.current = Vec3(-0.8, 0.0, 0.0);
    double most = 0.0;
    // until two pieces are on their way: the forces agree to 1e-12, but at 2.8 s those of a ship on
    // a prescribed course differ by 4e-6 all at once; the cause is not known
    while (goes.time < 2.7) {
        step(goes);
        step(rests);
        const auto [normal, tangent] = ship_on_ice(goes);
        const auto [normal_2, tangent_2] = ship_on_ice(rests);
        most = std::max(most, (normal + tangent).norm());
        CAPTURE(goes.time, free);
        // rounding of places, over the crushed depths of millimetres that give the forces
        REQUIRE((normal + tangent - normal_2 - tangent_2).norm() <= tolerance(1e-9) * (1.0 + most));
        REQUIRE(goes.edge.pieces().size() == rests.edge.pieces().size());
    }
    CHECK(goes.edge.pieces().size() > 1);
    CHECK(goes.edge.areas().sheet == Near(rests.edge.areas().sheet).epsilon(1e-9));
    const Vec3 ship = goes.scene.bodies.position[kShip] - rests.scene.bodies.position[kShip];
    for (const IcePiece& piece : goes.edge.pieces()) {
        const auto i = static_cast<std::size_t>(piece.body);
        CHECK((goes.scene.bodies.position[i] - rests.scene.bodies.position[i] - ship).norm() <
              tolerance(1e-6));
    }
}

TEST_CASE("level ice goes on from a checkpoint, and by any number of threads, with the same bits",
          "[live_edge][level_ice][edge][checkpoint]") {
    const TempFolder folder;
    Case p = sheet_case(0.8, 4.0);
    p.floes_move_water = GENERATE(false, true);
    World whole = make_world(p);
    run(whole, {folder / "whole", "first"});
    REQUIRE(whole.edge.pieces().size() > 3);
    for (const IcePiece& piece : whole.edge.pieces()) {
        const auto i = static_cast<std::size_t>(piece.body);
        const double heave = whole.scene.bodies.inertia_row_of(i).added(2, 2);
        // of a plate: more than half of its mass in any case
        CHECK((heave > 0.5 * whole.scene.bodies.mass[i]) == p.floes_move_water);
    }
    for (const std::int64_t stop : {1, 90, 151}) {
        CAPTURE(stop);
        World first = make_world(p);
        RunOptions options{folder / "parts", "first"};
        options.keep_going = [&](double, const World& now) { return now.steps < stop; };
        REQUIRE(run(first, options).status == "interrupted");
        World second = make_world(p);
        SavedRun saved = read_checkpoint(folder / "parts" / "checkpoint.h5", second);
        options = {folder / "parts", "first"};
        options.saved = &saved;
        const int before = thread_count();
        set_thread_count(stop % 2 == 0 ? 1 : 3);
        run(second, options);
        set_thread_count(before);
        check_same_runs(folder / "whole", folder / "parts", p.track);
        REQUIRE(second.edge.pieces().size() == whole.edge.pieces().size());
        REQUIRE(second.edge.sheet().loops() == whole.edge.sheet().loops());
        REQUIRE(second.edge.lost().size() == whole.edge.lost().size());
        REQUIRE(second.edge.rest() == whole.edge.rest());
    }
}

TEST_CASE("there are slots for all pieces and tiles from half a length astern to two radii ahead",
          "[live_edge][level_ice][edge][analytic]") {
    const World w = make_world(sheet_case(0.8, 4.0));
    // a ship of 12 x 4 m, and three radii on both sides
    const double r = w.edge.radius();
    const double along = 12.0 + 6.0 + 2.0 * r, across = 4.0 + 6.0 * r;
    // pieces of a quarter of half a disc each; tiles, cells of a radius, six and four abreast
    const double pieces = along * across / (0.25 * 0.5 * kPi * r * r);
    const double tiles = 6.0 * along / r + 4.0 * across / r;
    // 0.1 % is pi of three digits
    CHECK(static_cast<double>(w.scene.bodies.size() - 1) ==
          Near(pieces + tiles).epsilon(2e-3).margin(1.0));
}

TEST_CASE("the sheet's edge astern of the ship is no floe behind it",
          "[live_edge][level_ice][edge]") {
    const TempFolder folder;
    Case p = sheet_case(0.0, 0.02);
    p.hull_position.x() = 20.0;  // within the sheet: edge on all sides of the ship
    World w = make_world(p);
    const auto tiles = tiles_of(w.edge, w.scene.bodies);
    REQUIRE(std::any_of(tiles.begin(), tiles.end(), [&](std::int32_t tile) {
        return is_behind(w.scene, static_cast<std::size_t>(tile));
    }));
    const Summary summary = run(w, {folder / "run", "first"});
    CHECK(summary.floes_total == 0);
    CHECK(summary.floes_behind == 0);
}
