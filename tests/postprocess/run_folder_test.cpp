// SPDX-License-Identifier: GPL-3.0-or-later
// Tolerances: 1e-12 is rounding of a time.
#include <catch2/catch.hpp>
#include <functional>

#include "tests/postprocess/make_folder.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using namespace ice::test;

TEST_CASE("a run is found by its folder or by a file inside it", "[read]") {
    const TempFolder folder;
    const read::RunFolder made = make_folder();
    write_run(folder / "run.h5", made.data);
    write_bytes(folder / "summary.json", summary_text(*made.summary));
    for (const auto& path : {folder.path(), folder / "run.h5", folder / "summary.json"}) {
        const read::RunFolder run = read::read_run_folder(path);
        CHECK(run.path == folder.path());
        CHECK(run.data.frames.size() == 45);
        REQUIRE(run.summary);
        CHECK(run.summary->resistance.mean == 1107.0);
        CHECK(read::find_summary(folder.path()) == folder / "summary.json");
    }
}

TEST_CASE("a run has the poses, forces and times that were written", "[read][analytic]") {
    // one floe, two frames with two rows of history each; powers of two, exact in any format
    const TempFolder folder;
    RunData made = make_run({.floes = 1, .frames = 2, .samples_per_frame = 2});
    made.frames[1].position[0] = Vec3(12.5, -0.75, -0.125);
    made.frames[1].ship_position = Vec3(0.25, 0.0, -0.5);
    made.history[3].contact_force = Vec3(-1024.0, 16.0, 256.0);
    made.history[3].friction_force = Vec3(-128.0, 0.0, 32.0);
    write_run(folder / "run.h5", made);
    const read::RunFolder run = read::read_run_folder(folder / "run.h5");
    REQUIRE(run.data.frames.size() == 2);
    REQUIRE(run.data.history.size() == 4);
    CHECK(run.data.frames[1].position.at(0) == Vec3(12.5, -0.75, -0.125));
    CHECK(run.data.frames[1].ship_position == Vec3(0.25, 0.0, -0.5));
    CHECK(run.data.history[3].contact_force == Vec3(-1024.0, 16.0, 256.0));
    CHECK(run.data.history[3].friction_force == Vec3(-128.0, 0.0, 32.0));
    // rows lie 0.05 s apart: 0, 0.05, 0.1, 0.15 s
    CHECK(run.data.history[3].time == Near(0.15).epsilon(1e-12));
    CHECK(run.data.header.body_mass.at(0) == 144.0);
    CHECK_FALSE(run.summary);
}

TEST_CASE("a killed run is read from run.h5.part and has no summary", "[read]") {
    const TempFolder folder;
    const RunData run = make_run();
    {
        RunWriter writer(folder / "run.h5", run.header);
        add_frames(writer, run, 30);
    }
    const read::RunFolder back = read::read_run_folder(folder.path());
    CHECK(back.data.frames.size() == 20);
    CHECK_FALSE(back.summary);
    CHECK_THAT(error_text([&] { read::find_summary(folder.path()); }),
               Catch::Contains("still goes on, or was killed"));
}

TEST_CASE("a folder that does not exist or holds no run is named", "[read]") {
    const TempFolder folder;
    CHECK_THAT(error_text([&] { read::read_run_folder(folder / "no"); }),
               Catch::Contains("no: run folder not found"));
    CHECK_THAT(error_text([&] { read::read_run_folder(folder.path()); }),
               Catch::Contains("holds no run.h5"));
    // a case is told from the folder it lies in
    write_bytes(folder / "first.cfg", "title = \"x\"\n");
    for (const auto& reads :
         {std::function<void()>([&] { read::read_run_folder(folder / "first.cfg"); }),
          std::function<void()>([&] { read::find_summary(folder / "first.cfg"); })})
        CHECK_THAT(error_text(reads), Catch::Contains("first.cfg: is a file, not a run folder") &&
                                          Catch::Contains("give the folder that icesolve wrote"));
}
