// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "tests/postprocess/make_folder.hpp"

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
}
