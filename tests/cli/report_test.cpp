// SPDX-License-Identifier: GPL-3.0-or-later
// The report at the end of a run: icesolve asks icepost, which lies beside it, for it.
#include "tests/cli/workshop.hpp"

using namespace ice::test;

TEST_CASE("a run ends with its report unless told not to, and icepost makes the same again",
          "[cli]") {
    const Workshop w;
    w.make_case();
    const Result r = w.run("icesolve case.cfg --out a");
    CAPTURE(r.err);
    REQUIRE(r.code == 0);
    CHECK(r.out.empty());
    CHECK_THAT(r.err, Catch::Contains("report in a/report.html"));
    CHECK_THAT(slurp(w / "a/run.log"), Catch::Contains("report in a/report.html"));
    const std::string page = slurp(w / "a/report.html");
    CHECK_THAT(page.substr(0, 2000), Catch::Contains("<title>short</title>"));

    REQUIRE(w.run("icesolve case.cfg --out b --no-report").code == 0);
    CHECK_FALSE(fs::exists(w / "b/report.html"));
    fs::rename(w / "a/report.html", w / "a/old.html");
    REQUIRE(w.run("icepost report a").code == 0);
    CHECK(slurp(w / "a/report.html") == page);  // made again, the same bytes
}

TEST_CASE("a run without icepost, or with one that fails, is complete and warns", "[cli]") {
    const Workshop w;
    w.make_case("[drag]\nmodel = \"none\"\n");
    fs::copy(ICE_BIN "/icesolve", w / "icesolve");
    const std::string command =
        "icesolve --version >/dev/null && ./icesolve case.cfg --out a --overwrite";
    const Result alone = w.run(command);
    CHECK(alone.code == 0);
    CHECK_THAT(alone.err, Catch::Contains("icepost does not lie beside icesolve; try icepost "
                                          "report a"));
    w.write("icepost", "#!/bin/sh\nexit 3\n");
    fs::permissions(w / "icepost", fs::perms::owner_all);
    const Result failing = w.run(command);
    CHECK(failing.code == 0);
    CHECK_THAT(failing.err, Catch::Contains("icepost ended with code 3"));
    CHECK(fs::exists(w / "a/summary.json"));
    CHECK(w.run(command + " -q").err.empty());
}
