// SPDX-License-Identifier: GPL-3.0-or-later
// A case of level ice alone: laid, broken, continued.
#include "common/formats/field_file.hpp"
#include "common/formats/summary_file.hpp"
#include "tests/cli/workshop.hpp"

using namespace ice;
using namespace ice::test;

namespace {

// A 30 m model of the icebreaker in thin ice, a few pieces long.
const char* const kCase =
    "[simulation]\nduration = 4.0\ntime_step = 0.02\n[hull]\nspheres = \"hull.h5\"\n"
    "position = [-30.0, 0]\ndraught = 2.6\nspeed = 1.0\n"
    "[level_ice]\nthickness = 0.3\nextent = [0, 12, -8, 8]\nspacing = 0.3\n"
    "[contact]\nrestitution = 0.1\n";

void prepare(const Workshop& w) {
    w.write("case.cfg", kCase);
    REQUIRE(w.run("spherize " ICE_MESHES
                  "/icebreaker-100m.obj --scale 0.32 -r 0.3 -s 0.5 --mode surface -o hull.h5 -q")
                .code == 0);
}

fs::path laid(const Workshop& w) {
    for (const auto& entry : fs::directory_iterator(w / "."))
        if (entry.path().filename().string().starts_with("level-ice.")) return entry.path();
    return {};
}

}  // namespace

TEST_CASE("level ice is laid once, breaks as it bends, and another seed is other ice",
          "[cli][level_ice]") {
    const Workshop w;
    prepare(w);
    const Result first = w.run("icesolve case.cfg --out run --no-report");
    CAPTURE(first.err);
    REQUIRE(first.code == 0);
    CHECK_THAT(first.err + first.out, Catch::Contains("breaking the level ice along the course"));
    const fs::path file = laid(w);
    REQUIRE_FALSE(file.empty());
    const Field field = read_field(file);
    std::size_t fixed = 0;
    for (const FieldFloe& floe : field.floes) fixed += floe.fixed ? 1 : 0;
    CHECK(field.floes.size() - fixed > 10);
    CHECK(fixed > 2);
    const Summary s = read_summary(w / "run" / "summary.json");
    CHECK(s.floes_total == static_cast<std::int64_t>(field.floes.size()));
    CHECK(s.floes_moved > 0);
    REQUIRE(s.resistance.breaking_mean);
    CHECK(s.energy.at("breaking_J") > 0.0);
    CHECK(s.ice.hold == std::vector<std::string>{"until-bent", "always"});
    // the second run reads what the first one laid
    const Result again = w.run("icesolve case.cfg --out again --no-report --threads 1");
    REQUIRE(again.code == 0);
    CHECK_THAT(again.err + again.out, !Catch::Contains("breaking the level ice"));
    CHECK(read_summary(w / "again" / "summary.json").state_hash == s.state_hash);
    // so does one that is stopped and goes on; laid anew it is the same ice
    fs::remove(file);
    const Result anew = w.run("icesolve case.cfg --out anew --no-report");
    REQUIRE(anew.code == 0);
    CHECK(read_summary(w / "anew" / "summary.json").state_hash == s.state_hash);
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
    refuses("level_ice.extent=[100,120,-8,8]", "the ship does not reach the ice");
    refuses("contact.crushing_pressure=inf", "needs a finite contact.crushing_pressure");
    refuses("level_ice.thickness=-1", "level_ice.thickness");
    CHECK(laid(w).empty());
}
