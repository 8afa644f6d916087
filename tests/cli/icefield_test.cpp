// SPDX-License-Identifier: GPL-3.0-or-later
// icefield as a user meets it, and a run that takes its field.
#include <map>

#include "common/formats/field_file.hpp"
#include "common/formats/summary_file.hpp"
#include "tests/cli/workshop.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using namespace ice::test;

namespace {

const char* const kSpec =
    "title = \"A small channel\"\npattern = \"grid\"\n[ice]\nthickness = \"0.3 m\"\n"
    "[spheres]\nradius = 0.05\nspacing = 0.2\n"
    "[floes]\nsize = [1.0, 0.8]\ncount = [3, 3]\ngap = [0.1, 0.1]\n"
    "[edges]\nbreadth = 1\ngap = 0.1\noverhang = [2, 2]\n";

}  // namespace

TEST_CASE("icefield makes a field, a report and a picture", "[cli]") {
    const Workshop w;
    w.write("channel.toml", kSpec);
    const Result r = w.run("icefield channel.toml --json field.json --preview field.svg");
    CAPTURE(r.err);
    CHECK(r.code == 0);
    CHECK_THAT(r.out, Catch::Contains("9 of 3 shapes, and 5 pieces of unbroken ice"));
    const Field field = read_field(w / "channel.h5");
    CHECK(field.floes.size() == 14);
    CHECK_THAT(field.command_line, Catch::Contains("--preview field.svg"));
    CHECK_THAT(field.created_by, Catch::StartsWith("icefield "));
    const auto json = read_json_numbers(w / "field.json");
    CHECK(json.at("floes") == 9);
    CHECK(json.at("unbroken_pieces") == 5);
    CHECK(json.at("concentration") == Near(9 * 0.8 / (3.2 * 2.6)));
    const std::string svg = slurp(w / "field.svg");
    std::size_t paths = 0;
    for (std::size_t at = 0; (at = svg.find("<path", at)) != std::string::npos; ++at) ++paths;
    CHECK(paths == 9 + 4 + 1);  // floes, sides, the end ahead
    for (const char* words : {"x [m], the ship's way", "y [m], to port", "9 loose floes",
                              "unbroken ice", "<polyline", "Ice field from above, "})
        CHECK_THAT(svg, Catch::Contains(words));
}

TEST_CASE("icefield refuses with exit code 2 and leaves nothing behind", "[cli][errors]") {
    const Workshop w;
    w.write("channel.toml", kSpec);
    const auto refuses = w.refusing("icefield ");
    refuses("", "no specification given");
    refuses("lost.toml", "field specification not found");
    refuses("channel.toml --set floes.conut=3", "did you mean 'floes.count'?");
    refuses("channel.toml --set ice.thickness=0.09", "does not fit into ice of 0.09 m");
    refuses("channel.toml -o channel.toml", "--output: would overwrite the specification");
    refuses("channel.toml --json x.svg --preview x.svg", "--preview: would overwrite --json");
    refuses("channel.toml --explain gap", "did you mean 'floes.gap'");
    CHECK_FALSE(fs::exists(w / "channel.h5"));
    CHECK(slurp(w / "channel.toml") == kSpec);
    const Result disk = w.run("icefield channel.toml -o no/such/folder/field.h5");
    CHECK(disk.code == 1);
    CHECK_THAT(disk.err,
               Catch::Contains("--output: cannot write no/such/folder/field.h5: no folder "
                               "no/such/folder") &&
                   Catch::Contains("make the folder"));
}

TEST_CASE("icefield prints and explains its keys", "[cli]") {
    const Workshop w;
    const Result defaults = w.run("icefield --print-defaults");
    CHECK(defaults.code == 0);
    CHECK_THAT(defaults.out, Catch::Contains("[floes]\n") && Catch::Contains("jitter = 0.5"));
    CHECK_THAT(w.run("icefield --explain floes.exponent").out, Catch::Contains("size^-a"));
    CHECK_THAT(w.run("icefield --print-schema").out, Catch::Contains("\"breaking_length\""));
}

TEST_CASE("icesolve runs a field: loose floes move, unbroken ice stays", "[cli]") {
    const Workshop w;
    w.write("channel.toml", kSpec);
    w.write("case.cfg",
            "[simulation]\nduration = 2.0\ntime_step = 0.01\n[hull]\n"
            "spheres = \"hull.h5\"\nposition = [-1.2, 0, 0]\nspeed = 0.5\n"
            "[[floes]]\npattern = \"file\"\nfile = \"channel.h5\"\nhold = \"until-contact\"\n");
    REQUIRE(w.run("icefield channel.toml -q").code == 0);
    REQUIRE(w.run("spherize " ICE_MESHES "/paper-floe-3d.obj -r 0.1 -s 0.2 -o hull.h5 -q").code ==
            0);
    const Result r = w.run("icesolve case.cfg --out run");
    CAPTURE(r.err);
    REQUIRE(r.code == 0);
    const auto summary = read_json_numbers(w / "run" / "summary.json");
    CHECK(summary.at("floes.total") == 14);
    CHECK(summary.at("floes.moved") >= 1);
    CHECK(summary.at("floes.moved") <= 9);  // not the edges
}
