// SPDX-License-Identifier: GPL-3.0-or-later
// A case of level ice alone: laid, broken, continued.
//
// Tolerances: 1e-3 m is a place stored as a float; 20 % is the scatter of the breaking length.
#include "common/formats/pieces_file.hpp"
#include "common/formats/summary_file.hpp"
#include "tests/cli/workshop.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using namespace ice::test;

namespace {

// A 30 m model of the icebreaker in thin ice, a few pieces long.
const char* const kCase =
    "[simulation]\nduration = 8.0\ntime_step = 0.02\n[hull]\nspheres = \"hull.h5\"\n"
    "position = [-30.0, 0]\ndraught = 2.6\nspeed = 1.0\n"
    "[level_ice]\nthickness = 0.3\nextent = [0, 12, -8, 8]\nspacing = 0.3\n"
    "[contact]\nrestitution = 0.1\n";

void prepare(const Workshop& w) {
    w.write("case.cfg", kCase);
    REQUIRE(w.run("spherize " ICE_MESHES
                  "/icebreaker-100m.obj --scale 0.32 -r 0.3 -s 0.5 --mode surface -o hull.h5 -q")
                .code == 0);
}

// A section of the paper's hull in thin ice, a few pieces long.
const char* const kStrip =
    "[simulation]\ndimension = 2\nduration = 24.0\ntime_step = 0.01\n[hull]\nspheres = "
    "\"section.h5\"\nposition = [-9.8, 0]\ndraught = 1.2\nspeed = 0.5\n"
    "[level_ice]\nthickness = 0.1\nextent = [0, 30, 0, 0]\nspacing = 0.05\n"
    "[contact]\ncrushing_pressure = \"1 MPa\"\n";

void prepare_strip(const Workshop& w) {
    w.write("strip.cfg", kStrip);
    REQUIRE(w.run("spherize " ICE_MESHES
                  "/paper-hull-2d.obj --slice y=0 -r 0.05 --mode surface -o section.h5 -q")
                .code == 0);
}

}  // namespace

TEST_CASE("level ice whose modulus is in a wrong unit is refused with both reasons",
          "[cli][level_ice]") {
    const Workshop w;
    prepare(w);
    const Result r = w.run("icesolve case.cfg --check --set bending.elastic_modulus=5");
    CHECK(r.code == 2);
    CHECK_THAT(r.err, Catch::Contains("warning: bending.elastic_modulus = 5 Pa") &&
                          Catch::Contains("write \"5 GPa\""));
    CHECK_THAT(r.err, Catch::Contains("level_ice.extent: up to ") &&
                          Catch::Contains("check bending.elastic_modulus"));
    CHECK(r.err.find("warning:") < r.err.find("error:"));
}

TEST_CASE("level ice breaks where it is loaded, and another seed is other ice",
          "[cli][level_ice]") {
    const Workshop w;
    prepare(w);
    const Result first = w.run("icesolve case.cfg --out run --no-report");
    CAPTURE(first.err);
    REQUIRE(first.code == 0);
    CHECK_THAT(first.err + first.out, Catch::Contains("characteristic lengths"));
    const Summary s = read_summary(w / "run" / "summary.json");
    CHECK(s.floes_total > 3);
    CHECK(s.floes_moved == s.floes_total);
    REQUIRE(s.resistance.breaking_mean);
    CHECK(s.energy.at("breaking_J") > 0.0);
    CHECK(s.ice.hold == std::vector<std::string>{"until-bent", "always"});
    // pieces and rest are the floes that a reader sees
    const PiecesFile pieces = read_pieces(w / "run" / kPiecesName);
    CHECK(static_cast<std::int64_t>(pieces.pieces.size()) == s.floes_total);
    const RunData run = read_run(w / "run" / "run.h5");
    REQUIRE(run.header.body_shape.size() ==
            pieces.pieces.size() + pieces.rest.size() + pieces.sheet.size());
    for (std::size_t k = 0; k < pieces.pieces.size(); ++k) {
        const PieceRow& row = pieces.pieces[k];
        CHECK(row.load > 0.0);
        CHECK((run.frames.front().position[k] - row.at).norm() < tolerance(1e-3));
        CHECK(run.frames.front().state[k] == FloeState::absent);
        CHECK(run.frames.back().state[k] ==
              (row.gone < 8.0 ? FloeState::behind : run.frames.back().state[k]));
        CHECK(run.frames.back().state[k] < FloeState::absent);
    }
    // at the start the sheet is whole, less the ship's own place
    double mass = 0.0;
    for (const auto* rows : {&pieces.rest, &pieces.sheet})
        for (const PieceRow& row : *rows) mass += row.mass;
    CHECK(mass == Near(12.0 * 16.0 * 0.3 * 900.0).epsilon(0.002));
    const Result again = w.run("icesolve case.cfg --out again --threads 1 --verify");
    CAPTURE(again.err);
    REQUIRE(again.code == 0);
    CHECK(read_summary(w / "again" / "summary.json").state_hash == s.state_hash);
    CHECK(fs::exists(w / "again" / "report.html"));
    const Result other = w.run("icesolve case.cfg --out other --no-report --set level_ice.seed=1");
    REQUIRE(other.code == 0);
    CHECK(read_summary(w / "other" / "summary.json").state_hash != s.state_hash);
}

TEST_CASE("the picture of the start has the whole sheet", "[cli][level_ice]") {
    const Workshop w;
    prepare(w);
    const Result r = w.run("icesolve case.cfg --check --picture start.svg");
    CAPTURE(r.err);
    REQUIRE(r.code == 0);
    CHECK(r.err.find("pieces broke off") == std::string::npos);
    const std::string svg = slurp(w / "start.svg");
    // the plate and, over the ship, its veil
    const std::string fill = "fill=\"#d2e1ed\"";
    const std::size_t at = svg.find(fill);
    REQUIRE(at != std::string::npos);
    CHECK(svg.find("<g opacity=\".45\"><path", at) != std::string::npos);
    // The path of the plate: relative steps between its corners [px]. 12 m of some 50 are seen; a
    // tile would be 2 m long.
    const char* step = svg.c_str() + svg.find('l', svg.rfind("d=\"M", at)) + 1;
    double x = 0.0, low = 0.0, high = 0.0;
    for (char* end = nullptr; *step != 'z' && *step != '"'; step = end) {
        x += std::strtod(step, &end);
        std::strtod(end, &end);
        low = std::min(low, x);
        high = std::max(high, x);
        REQUIRE(end != step);
    }
    CHECK(high - low > 100.0);
}

TEST_CASE("level ice that cannot be is refused with its key", "[cli][level_ice][errors]") {
    const Workshop w;
    prepare(w);
    const auto refuses = [&](const std::string& set, const std::string& words) {
        const Result r = w.run("icesolve case.cfg --check --set " + set);
        CAPTURE(set, r.err);
        CHECK(r.code == 2);
        CHECK_THAT(r.err, Catch::Contains(words));
    };
    refuses("level_ice.extent=[12,0,-8,8]", "level_ice.extent is empty");
    refuses("contact.crushing_pressure=inf", "needs a finite contact.crushing_pressure");
    refuses("level_ice.thickness=-1", "level_ice.thickness");
    refuses("output.track=[1]", "pieces that break off [level_ice] cannot be tracked");
    refuses("level_ice.spacing=0.5", "level_ice.spacing = 0.5 m is more than 1.5 thicknesses");
    refuses("level_ice.gap=1.8", "level_ice.gap: 1.8 m leave no ice");
    refuses("hull.position=[-20,0]", "with x = -29.7 m its bow lies before the ice");
    CHECK(w.run("icesolve case.cfg --check --set hull.position=[-29.7,0]").code == 0);
    CHECK(w.run("icesolve case.cfg --check --allow-overlap --set hull.position=[-20,0]").code == 0);
    const Result far = w.run("icesolve case.cfg --check --set level_ice.extent=[100,120,-8,8]");
    CHECK(far.code == 0);
    CHECK_THAT(far.err + far.out, Catch::Contains("never meets the ice"));
}

TEST_CASE("a run that ends before any ice broke is one in level ice, and tells of it",
          "[cli][level_ice]") {
    const Workshop w;
    prepare(w);
    // strong ice, and a ship that is in it by more than a crack's length at the end
    const Result r = w.run(
        "icesolve case.cfg --out run --no-report --set bending.factor=50 --set level_ice.gap=0.02 "
        "--set simulation.duration=4");
    CAPTURE(r.err);
    REQUIRE(r.code == 0);
    CHECK_THAT(r.err + r.out, Catch::Contains("no piece broke off, although the ship is") &&
                                  Catch::Contains("level ice: 0 pieces broke off"));
    const Summary s = read_summary(w / "run" / "summary.json");
    CHECK(s.ice.hold == std::vector<std::string>{"until-bent", "always"});
}

TEST_CASE("in 2D level ice breaks off in a beam's lengths", "[cli][level_ice][strip]") {
    const Workshop w;
    prepare_strip(w);
    const Result check = w.run("icesolve strip.cfg --check");
    CAPTURE(check.err, check.out);
    REQUIRE(check.code == 0);
    // pi / 4 (E h^3 / (3 rho_w g))^(1/4) at the default 5 GPa, and 0.680 sigma_f (...)^(1/4)
    CHECK_THAT(check.err + check.out, Catch::Contains("cracks 2.84 m from the tip"));
    CHECK_THAT(check.err + check.out, Catch::Contains("under 0.716 kN/m"));
    const Result first = w.run("icesolve strip.cfg --out run --verify");
    CAPTURE(first.err);
    REQUIRE(first.code == 0);
    CHECK_THAT(first.err + first.out, Catch::Contains("m from the tip"));
    CHECK(fs::exists(w / "run" / "report.html"));
    const Summary s = read_summary(w / "run" / "summary.json");
    CHECK(s.floes_total >= 3);
    REQUIRE(s.resistance.breaking_mean);
    CHECK(s.energy.at("breaking_J") > 0.0);
    const PiecesFile pieces = read_pieces(w / "run" / kPiecesName);
    REQUIRE(static_cast<std::int64_t>(pieces.pieces.size()) == s.floes_total);
    for (const PieceRow& row : pieces.pieces) {
        CHECK(row.radius == Near(2.8355).epsilon(0.2));  // and its scatter
        CHECK(row.load >= 715.0);
        CHECK(row.at.y() == 0.0);
    }
    const Result again = w.run("icesolve strip.cfg --out again --threads 1 --no-report");
    REQUIRE(again.code == 0);
    CHECK(read_summary(w / "again" / "summary.json").state_hash == s.state_hash);
    const Result other = w.run("icesolve strip.cfg --out other --no-report --set level_ice.seed=1");
    REQUIRE(other.code == 0);
    CHECK(read_summary(w / "other" / "summary.json").state_hash != s.state_hash);
}

TEST_CASE("level ice in 2D that cannot be is refused with its key",
          "[cli][level_ice][strip][errors]") {
    const Workshop w;
    prepare_strip(w);
    const auto refuses = [&](const std::string& set, const std::string& words) {
        const Result r = w.run("icesolve strip.cfg --check --set " + set);
        CAPTURE(set, r.err);
        CHECK(r.code == 2);
        CHECK_THAT(r.err, Catch::Contains(words));
    };
    refuses("contact.crushing_pressure=inf", "needs a finite contact.crushing_pressure");
    refuses("level_ice.extent=[30,0,0,0]", "level_ice.extent is empty");
    refuses("level_ice.length_factor=0.4", "level_ice.length_factor is for cases of dimension 3");
    refuses("level_ice.speed_factor=0", "level_ice.speed_factor is for cases of dimension 3");
    refuses("bending.model=\\\"kashtelyan\\\"", "is for cases of dimension 3");
    refuses("ice.density=1000", "the sheet has no floating equilibrium");
}
