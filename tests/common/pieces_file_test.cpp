// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/formats/pieces_file.hpp"

#include <catch2/catch.hpp>

#include "tests/common/fixtures.hpp"

using namespace ice;
using namespace ice::test;

namespace {

// One slot, in which a piece is from 1 s on, broken out of a part of the sheet; the rest beside it.
PiecesFile one_piece() {
    PiecesFile file;
    file.first_body = 1;
    file.piece_group = 0;
    file.rest_group = 1;
    PieceRow row{make_box({1.0, 0.8, 0.2}), Vec3(9.0, 0.0, -0.08), 144.0};
    file.rest = {row};
    row.gone = 1.0;
    file.sheet = {row};
    row.number = row.body = 1;
    row.born = 1.0;
    row.gone = 100.0;
    file.pieces = {row};
    return file;
}

}  // namespace

TEST_CASE("before a piece breaks off, the part of the sheet around it is there in its place",
          "[run_file][level_ice]") {
    const TempFolder folder;
    write_pieces(folder / kPiecesName, one_piece());
    PiecesFile file = read_pieces(folder / kPiecesName);
    REQUIRE(file.sheet.size() == 1);
    CHECK(file.sheet[0].gone == 1.0);
    CHECK(file.sheet[0].mesh.triangles.size() == 12);

    RunData run = make_run({.floes = 1, .frames = 21});  // 0.1 s apart
    const RunData before = run;
    show_pieces(file, run);
    CHECK(run.header.sheet_group == 1);
    CHECK(run.header.body_group == std::vector<std::int32_t>{0, 1, 1});
    for (const RunFrame& frame : run.frames) {
        CAPTURE(frame.time);
        const bool broken = frame.time > 1.0;
        REQUIRE(frame.state.size() == 3);
        CHECK((frame.state[0] == FloeState::absent) == !broken);
        CHECK(frame.state[1] == FloeState::held);
        CHECK(frame.state[2] == (broken ? FloeState::absent : FloeState::held));
    }

    // a file of before has no parts: the piece is held ice until it breaks off
    file.sheet.clear();
    run = before;
    show_pieces(file, run);
    CHECK(run.frames.front().state == std::vector<FloeState>(2, FloeState::held));
}
