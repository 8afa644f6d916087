// SPDX-License-Identifier: GPL-3.0-or-later
// The edge of level ice under many loads and on a long way: sheet, memory, pieces that are gone.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "common/formats/checkpoint_file.hpp"
#include "tests/support/small_icebreaker.hpp"

using namespace ice;
using namespace ice::test;

namespace {

// Loads that nothing bears, on random corners of random tiles, in random directions.
// @return pieces that broke off
std::size_t press_at_random(int loads) {
    std::mt19937 random(12);
    const auto pick = [&](std::size_t count) {
        return std::uniform_int_distribution<std::size_t>(0, count - 1)(random);
    };
    Case p = sheet_case(0.0, 1e3);
    p.hull_position.x() = 4.0;  // within the sheet: an edge on all sides of the ship
    std::size_t pieces = 0;
    for (int done = 0; done < loads;) {
        World w = make_world(p);
        std::size_t seen = 0;
        for (; done < loads && w.edge.pieces().size() < 80; ++done) {
            const auto tiles = tiles_of(w.edge, w.scene.bodies);
            CAPTURE(done, w.edge.sheet().area(), w.edge.pieces().size());
            REQUIRE_FALSE(tiles.empty());
            const std::int32_t tile = tiles[pick(tiles.size())];
            const double turn =
                std::uniform_real_distribution<double>(0.0, 2.0 * std::numbers::pi)(random);
            const auto shape = w.scene.bodies.shape[static_cast<std::size_t>(tile)];
            const auto& mesh = w.scene.shapes[static_cast<std::size_t>(shape)].mesh;
            press_edge(w.edge, w.scene, w.parameters, tile, pick(mesh.vertices.size()), turn);
            CAPTURE(done, turn);
            REQUIRE(w.edge.is_due(w.scene));
            REQUIRE(w.edge.renew(w.scene, w.parameters, 0.01 * done));
            REQUIRE(edge_fault(w.edge, 40.0 * 16.0, seen, done % 20 == 0) == "");
            seen = w.edge.pieces().size();
        }
        pieces += seen;
    }
    return pieces;
}

}  // namespace

TEST_CASE("loads anywhere on the edge leave a valid sheet and keep its area",
          "[live_edge][level_ice][edge][fuzz][long]") {
    CHECK(press_at_random(500) > 250);
}

TEST_CASE("ten thousand loads anywhere on the edge leave a valid sheet",
          "[.][live_edge][level_ice][edge][slow]") {
    CHECK(press_at_random(10000) > 5000);
}

TEST_CASE("a long way through level ice takes no more memory than what is within reach",
          "[live_edge][level_ice][edge][step][long]") {
    Case p = sheet_case(1.5, 1e3);
    p.level_ice.extent[1] = 400.0;
    World w = make_world(p);
    std::size_t corners = 0, recesses = 0;
    std::int64_t alive = 0;
    const auto run_until = [&](double until) {
        corners = recesses = 0;
        alive = 0;
        while (w.time < until) {
            step(w);
            std::size_t now = 0;
            for (const Loop& loop : w.edge.sheet().loops()) now += loop.size();
            corners = std::max(corners, now);
            recesses = std::max(recesses, w.scene.crushed.displacement.size());
            alive = std::max(alive, w.edge.alive());
        }
    };
    run_until(20.0);
    const std::size_t corners_then = corners, recesses_then = recesses;
    const std::int64_t alive_then = alive;
    REQUIRE(w.edge.retired() > 0);
    const std::int64_t gone_then = w.edge.retired();
    const TempFolder folder;
    w.edge.keep_gone_in(folder / "");
    run_until(40.0);
    CAPTURE(corners, corners_then, recesses, recesses_then, alive, alive_then);
    CHECK(static_cast<double>(corners) < 1.5 * static_cast<double>(corners_then));
    CHECK(static_cast<double>(recesses) < 2.0 * static_cast<double>(recesses_then));
    CHECK(static_cast<double>(alive) < 1.5 * static_cast<double>(alive_then));

    // those that are gone are on the disk, and a checkpoint holds all
    REQUIRE(w.edge.retired() > gone_then);
    const std::vector<IcePiece> pieces = w.edge.pieces();
    REQUIRE(static_cast<std::int64_t>(pieces.size()) == w.edge.broken());
    {
        CheckpointFile file(folder / "edge.h5", CheckpointFile::Direction::write);
        w.edge.carry(file);
        file.finish();
    }
    World second = make_world(p);
    CheckpointFile file(folder / "edge.h5", CheckpointFile::Direction::read);
    second.edge.carry(file);
    const std::vector<IcePiece> again = second.edge.pieces();
    REQUIRE(again.size() == pieces.size());
    std::int64_t gone = 0;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
        REQUIRE(pieces[k].number == static_cast<std::int64_t>(k) + 1);
        REQUIRE(again[k].number == pieces[k].number);
        REQUIRE(again[k].gone == pieces[k].gone);
        REQUIRE(again[k].outline == pieces[k].outline);
        gone += std::isinf(pieces[k].gone) ? 0 : 1;
    }
    CHECK(gone == w.edge.retired());
    CHECK(second.edge.retired() == w.edge.retired());
}
