// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of a sheet of level ice that are there no more: pictures of earlier times need them.
//
// Tolerance: 0.05 m2 of 640 is what is left out along the parts' edges, 1 mm at most.
#include <catch2/catch.hpp>

#include "solver/live_edge/edge_record.hpp"
#include "tests/support/edge_checks.hpp"
#include "tests/support/make_worlds.hpp"
#include "tests/support/small_icebreaker.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using namespace ice::test;

TEST_CASE("the rest of a sheet and the parts that went later are the sheet at any time",
          "[live_edge][level_ice][edge]") {
    World w = make_world(sheet_case(2.0, 1e3));
    const double dt = w.parameters.time_step;
    std::vector<std::pair<double, double>> seen;  // time, unbroken ice with that astern
    while (w.time < 12.0) {
        step(w);
        seen.emplace_back(w.time - dt, w.edge.areas().sheet + w.edge.areas().astern);
    }
    REQUIRE(w.edge.areas().astern > 1.0);
    double rest = 0.0, at_start = 0.0;
    for (const Loop& loop : w.edge.rest()) rest += area_of(loop);
    const std::vector<IcePiece> lost = w.edge.lost();
    for (const IcePiece& part : lost) {
        CHECK(is_simple({part.outline}));
        CHECK(w.edge.sheet().area_in(part.outline) < tolerance(0.01));
        if (part.gone < 0.0) at_start += area_of(part.outline);
    }
    CHECK(rest + at_start < 40.0 * 16.0);
    for (const auto& [time, sheet] : seen) {
        double there = rest;
        for (const IcePiece& part : lost)
            if (part.gone > time + 0.5 * dt) there += area_of(part.outline);
        CAPTURE(time);
        REQUIRE(there == Near(sheet).margin(0.05));
    }
    // all of it goes into the file, but for the ship's own place
    const PiecesFile file = record_edge(w.edge);
    CHECK(file.rest.size() == w.edge.rest().size());
    CHECK(file.sheet.size() + 5 > lost.size());
    CHECK(file.sheet.size() > 15);
    for (const PieceRow& part : file.sheet) CHECK(part.gone > 0.0);
}
