// SPDX-License-Identifier: GPL-3.0-or-later
// A case of level ice alone: laid, broken, continued.
#include "common/formats/pieces_file.hpp"
#include "common/formats/summary_file.hpp"
#include "tests/cli/workshop.hpp"

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

}  // namespace

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
    REQUIRE(run.header.body_shape.size() == pieces.pieces.size() + pieces.rest.size());
    for (std::size_t k = 0; k < pieces.pieces.size(); ++k) {
        const PieceRow& row = pieces.pieces[k];
        CHECK(row.load > 0.0);
        CHECK((run.frames.front().position[k] - row.at).norm() < 1e-3);
        CHECK(run.frames.front().state[k] == FloeState::held);
        CHECK(run.frames.back().state[k] != FloeState::held);
    }
    const Result again = w.run("icesolve case.cfg --out again --threads 1 --verify");
    CAPTURE(again.err);
    REQUIRE(again.code == 0);
    CHECK(read_summary(w / "again" / "summary.json").state_hash == s.state_hash);
    CHECK(fs::exists(w / "again" / "report.html"));
    const Result other = w.run("icesolve case.cfg --out other --no-report --set level_ice.seed=1");
    REQUIRE(other.code == 0);
    CHECK(read_summary(w / "other" / "summary.json").state_hash != s.state_hash);
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
    const Result far = w.run("icesolve case.cfg --check --set level_ice.extent=[100,120,-8,8]");
    CHECK(far.code == 0);
    CHECK_THAT(far.err + far.out, Catch::Contains("never meets the ice"));
}
