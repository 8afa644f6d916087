// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures and pipes: a file holds what its name says, and a reader that goes loses nothing.
#include "common/formats/summary_file.hpp"
#include "tests/cli/workshop.hpp"

using namespace ice;
using namespace ice::test;

namespace {

void make_run(const Workshop& w) {
    w.make_case();
    REQUIRE(w.run("icesolve case.cfg -q --no-report --out r --set simulation.duration=1.5").code ==
            0);
}

bool no_part_files(const Workshop& w) {
    for (const std::string& name : w.files())
        if (name.find(".part") != std::string::npos) return false;
    return true;
}

}  // namespace

TEST_CASE("a picture is what its suffix says, or is refused", "[cli]") {
    const Workshop w;
    make_run(w);
    const bool converts = std::system("command -v rsvg-convert >/dev/null") == 0;
    const auto begins = [&](const std::string& command, const std::string& file,
                            const std::string& magic) {
        const Result r = w.run(command + " " + file);
        CAPTURE(command, file, r.err);
        if (converts || file.ends_with(".svg")) {
            CHECK(r.code == 0);
            CHECK(slurp(w / file).starts_with(magic));
        } else {
            CHECK(r.code == 2);
            CHECK_THAT(r.err, Catch::Contains("librsvg2-bin"));
            CHECK_FALSE(fs::exists(w / file));
        }
    };
    const std::string view = "icepost view r --time 1 -o", plot = "icepost plot r -o";
    for (const std::string& command : {view, plot}) {
        begins(command, "a.svg", "<svg");
        begins(command, "a.png", "\x89PNG");
        begins(command, "b.PNG", "\x89PNG");
        begins(command, "a.pdf", "%PDF");
    }
    w.write("field.toml",
            "pattern = \"grid\"\n[ice]\nthickness = 0.3\n[spheres]\nradius = 0.05\nspacing = 0.2\n"
            "[floes]\nsize = [1.0, 0.8]\ncount = [3, 3]\ngap = [0.1, 0.1]\n");
    begins("icefield field.toml -q -o f.h5 --preview", "field.png", "\x89PNG");

    const std::string field = "icefield field.toml -q -o never.h5 --preview";
    for (const std::string& command : {view, plot, field})
        for (const char* file : {"a.jpg", "drawing", "a.png.gz"}) {
            const Result r = w.run(command + " " + file);
            CAPTURE(command, file, r.err);
            CHECK(r.code == 2);
            CHECK_THAT(r.err, Catch::Contains(".svg, .png or .pdf"));
            CHECK_FALSE(fs::exists(w / file));
        }
    CHECK(w.run("icepost report r -o page.png").code == 2);
    CHECK_FALSE(fs::exists(w / "page.png"));
    // without the converter nothing is computed first
    const Result r =
        w.run("icesolve --version >/dev/null; PATH=/nowhere " ICE_BIN "/" + field + " x.png");
    CHECK(r.code == 2);
    CHECK_THAT(r.err, Catch::Contains("librsvg2-bin"));
    CHECK_FALSE(fs::exists(w / "never.h5"));
    CHECK(no_part_files(w));
}

TEST_CASE("a run whose reader goes, of its hashes, its messages or both, goes on to its end",
          "[cli]") {
    const Workshop w;
    w.make_case();
    REQUIRE(w.run("icesolve case.cfg -q --no-report --out whole").code == 0);
    const std::string run =
        ICE_BIN "/icesolve case.cfg --no-report --overwrite --out r --hash-every 1";
    // true ends at once, head after a line; the exit code of the run, not of the pipe
    for (const std::string& pipe :
         {run + "; echo $? >code) | true", run + " 2>&1; echo $? >code) | head -n 1 >/dev/null",
          run + " 2>&1 >/dev/null; echo $? >code) | true"}) {
        fs::remove(w / "code");
        w.run("icesolve --version >/dev/null; (" + pipe);
        CAPTURE(pipe);
        CHECK(slurp(w / "code") == "0\n");
        CHECK(read_summary(w / "r/summary.json").state_hash ==
              read_summary(w / "whole/summary.json").state_hash);
        CHECK_THAT(slurp(w / "r/run.log"), Catch::Contains("resistance"));
    }
    // what cannot be written for another reason is still a failure
    CHECK(w.run("icesolve --version >/dev/null; (" ICE_BIN
                "/icesolve case.cfg -q --no-report --overwrite --out r --json >/dev/full)")
              .code == 1);
}

TEST_CASE("the other programs finish their files when nobody reads their words", "[cli]") {
    const Workshop w;
    make_run(w);
    const auto ends = [&](const std::string& command, const std::string& file) {
        fs::remove(w / "code");
        w.run("icesolve --version >/dev/null; (" ICE_BIN "/" + command +
              " 2>&1; echo $? >code) | true");
        CAPTURE(command);
        CHECK(slurp(w / "code") == "0\n");
        CHECK(fs::exists(w / file));
        CHECK(no_part_files(w));
    };
    ends("spherize " ICE_MESHES "/paper-floe-3d.obj -r 0.05 -o s.h5 --export csv", "s.h5");
    ends("icepost table r", "r/run.h5");
    ends("icepost report r", "r/report.html");
    ends("icesolve --print-defaults", "case.cfg");
}

TEST_CASE("threads that wait sleep, unless there is one or the user says otherwise", "[cli]") {
    const Workshop w;
    w.make_case();
    const auto environment = [&](const std::string& variable, const std::string& threads) {
        const Result r = w.run(
            "icesolve --version >/dev/null; (rm -rf r; " + variable +
            " " ICE_BIN "/icesolve case.cfg -q --out r --set simulation.duration=5000 --threads " +
            threads +
            " & p=$!; for k in $(seq 600); do [ -e r/forces.csv.part ] && break; sleep 0.05; done; "
            "tr '\\0' '\\n' </proc/$p/environ | grep -E '^(OMP_WAIT|GOMP_SPIN)'; cat "
            "/proc/$p/comm; "
            "kill -9 $p)");
        return r.out;
    };
    const std::string clean = "env -u OMP_WAIT_POLICY -u GOMP_SPINCOUNT";
    CHECK(environment(clean, "2") == "OMP_WAIT_POLICY=passive\nicesolve\n");
    CHECK(environment(clean, "1") == "icesolve\n");
    CHECK(environment(clean + " OMP_WAIT_POLICY=active", "2") ==
          "OMP_WAIT_POLICY=active\nicesolve\n");
    CHECK(environment(clean + " GOMP_SPINCOUNT=7", "2") == "GOMP_SPINCOUNT=7\nicesolve\n");
}
