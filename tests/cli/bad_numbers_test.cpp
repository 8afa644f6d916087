// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers that are none, bodies in each other, meshes without area, inputs of absurd length.
#include "common/formats/spheres_file.hpp"
#include "common/formats/summary_file.hpp"
#include "tests/cli/workshop.hpp"

using namespace ice;
using namespace ice::test;

namespace {

struct Refusal {
    std::string command, words;
};

void check_refused(const Workshop& w, const Refusal& expected) {
    const Result r = w.run(expected.command);
    CAPTURE(expected.command, r.err);
    CHECK(r.code == 2);
    CHECK_THAT(r.err, Catch::Contains(expected.words));
    CHECK(r.err.size() < 4000);                                // a message, not a flood
    CHECK(std::count(r.err.begin(), r.err.end(), '\n') >= 2);  // with a remedy
}

// A hull of 10 x 4 x 4.5 m and floes of 1 x 0.8 x 0.3 m, five in a row ahead of it.
void make_case_3d(const Workshop& w) {
    REQUIRE(w.run("spherize " ICE_MESHES "/paper-hull-3d.obj -r 0.1 -s 0.2 --mode surface -o "
                  "hull.h5 -q")
                .code == 0);
    REQUIRE(w.run("spherize " ICE_MESHES "/paper-floe-3d.obj -r 0.1 -s 0.1 -o floe.h5 -q").code ==
            0);
    w.write("case.cfg", R"([simulation]
duration = 0.2
[hull]
spheres = "hull.h5"
position = [-9.6, 0, 0]
speed = 0.5
[flow]
model = "none"
[[floes]]
spheres = "floe.h5"
count = [5, 1]
origin = [0.05, 0]
)");
}

std::string repeat(const std::string& text, int count) {
    std::string out;
    for (int k = 0; k < count; ++k) out += text;
    return out;
}

}  // namespace

TEST_CASE("a vertex that is NaN or infinite is named", "[cli][errors]") {
    const Workshop w;
    const std::string number = GENERATE("nan", "NaN", "inf", "-inf", "1e400");
    w.write("x.obj", "v " + number +
                         " 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                         "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
    check_refused(w, {"spherize x.obj -q", "x.obj: vertex "});
    CHECK(w.files() == std::vector<std::string>{"x.obj"});
}

TEST_CASE("options of all programs take no NaN and no infinity", "[cli][errors]") {
    const Workshop w;
    w.make_case();
    const std::string number = GENERATE("nan", "inf", "1e400");
    CAPTURE(number);
    const std::string mesh = ICE_MESHES "/paper-floe-3d.obj";
    for (const char* option : {"--radius", "--spacing", "--scale", "--density"})
        check_refused(w, {"spherize " + mesh + " " + option + " " + number, option});
    check_refused(w, {"spherize " + mesh + " --slice y=" + number, "--slice"});
    check_refused(w, {"icesolve case.cfg --checkpoint-every " + number, "--checkpoint-every"});
    check_refused(w, {"icesolve case.cfg --set hull.speed=" + number, "hull.speed"});
    check_refused(w, {"icesolve case.cfg --set simulation.time_step=" + number, "time_step"});
    check_refused(w, {"icesolve case.cfg --set hull.speed='" + number + " kn'", "hull.speed"});
    check_refused(w, {"icesolve case.cfg --set hull.position=[0," + number + ",0]", "position"});
    check_refused(w, {"icepost view results --from below -o x.svg --time " + number, "--time"});
    w.write("field.toml",
            "pattern = \"grid\"\n[ice]\nthickness = 0.3\n[floes]\nsize = [1, " + number + "]\n");
    check_refused(w, {"icefield field.toml", "field.toml:5:"});
    CHECK_FALSE(fs::exists(w / "results"));
}

TEST_CASE("polygons with a NaN or infinity are refused with the place", "[cli][errors]") {
    const Workshop w;
    const std::string spec = "pattern = \"polygons\"\n[ice]\nthickness = 0.3\n[floes]\nfile = ";
    w.write("csv.toml", spec + "\"floes.csv\"\n");
    w.write("json.toml", spec + "\"floes.geojson\"\n");
    for (const std::string number : {"nan", "inf", "1e400"}) {
        CAPTURE(number);
        w.write("floes.csv", "1,0,0\n1,2," + number + "\n1,2,2\n");
        check_refused(w, {"icefield csv.toml", "floes.csv"});
        w.write("floes.geojson",
                "{\"type\":\"Polygon\",\"coordinates\":[[[0,0],[2," + number + "],[2,2],[0,0]]]}");
        check_refused(w, {"icefield json.toml", "floes.geojson"});
    }
    CHECK_FALSE(fs::exists(w / "csv.h5"));
}

TEST_CASE("a sphere file with a NaN, or an inertia that no solid has, is refused by the solver",
          "[cli][errors]") {
    const Workshop w;
    make_case_3d(w);
    const SphereSet good = read_spheres(w / "floe.h5");
    const auto spoil = [&](const auto& change, const std::string& words) {
        SphereSet set = good;
        change(set);
        write_spheres(w / "floe.h5", set, {});
        check_refused(w, {"icesolve case.cfg", words});
    };
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    spoil([](SphereSet& s) { s.centers[3].z() = kNan; }, "floe.h5: /center: holds a NaN");
    spoil([](SphereSet& s) { s.radii[3] = kNan; }, "floe.h5: /radius: holds a NaN");
    spoil([](SphereSet& s) { s.solid.inertia *= -1.0; }, "/solid: has a moment of inertia of -");
    spoil([](SphereSet& s) { s.solid.inertia(2, 2) *= 3.0; }, "above the sum of the others");
    spoil([](SphereSet& s) { s.solid.volume = 0.0; }, "/solid: has a volume of 0 m3");
    CHECK_FALSE(fs::exists(w / "results"));
}

TEST_CASE("meshes without area or volume are refused, whatever the repair", "[cli][errors]") {
    const Workshop w;
    w.write("line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nf 1 2 3\nf 2 3 4\nf 1 3 4\nf 1 2 4\n");
    w.write("point.obj", "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n");
    w.write("sheet.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n");
    w.write("folded.obj",
            "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\nf 3 2 1\nf 4 3 1\n");
    const std::string repair = GENERATE("auto", "strict", "wrap");
    CAPTURE(repair);
    for (const char* name : {"line", "point"})
        check_refused(
            w, {std::string("spherize ") + name + ".obj --repair " + repair, "has no area: its "});
    for (const char* name : {"sheet", "folded"})
        check_refused(w, {std::string("spherize ") + name + ".obj --repair " + repair,
                          "is not the closed surface of a solid"});
    CHECK(w.files().size() == 4);
}

TEST_CASE("a case whose floes overlap names them and the depth, and --allow-overlap goes on",
          "[cli][errors]") {
    const Workshop w;
    make_case_3d(w);
    std::string text = slurp(w / "case.cfg");
    w.write("case.cfg", text +
                            "[[floes]]\nspheres = \"floe.h5\"\npattern = \"single\"\n"
                            "position = [0.75, 0.6]\nhold = \"never\"\n");
    const std::string words = "floe 1 and floe 6 overlap by 0.2 m at the start";
    check_refused(w, {"icesolve case.cfg --out r", words});
    check_refused(w, {"icesolve case.cfg --check", "--allow-overlap"});
    CHECK_FALSE(fs::exists(w / "r"));
    const Result r = w.run("icesolve case.cfg --out r --allow-overlap");
    CAPTURE(r.err);
    CHECK(r.code == 0);
    // once on the terminal, and in what is kept
    const auto at = r.err.find(words);
    REQUIRE(at != std::string::npos);
    CHECK(r.err.find(words, at + 1) == std::string::npos);
    const auto warnings = read_summary(w / "r/summary.json").warnings;
    CHECK(std::any_of(warnings.begin(), warnings.end(), [&](const Warning& warning) {
        return warning.text.find(words) != std::string::npos;
    }));
    CHECK_THAT(slurp(w / "r/run.log"), Catch::Contains(words));
}

TEST_CASE("more floes than the limit are refused before memory is taken for them",
          "[cli][errors]") {
    const Workshop w;
    make_case_3d(w);
    for (const char* count : {"[100000,100000]", "[100000,100]"})
        check_refused(w, {std::string("icesolve case.cfg --check --set floes.count=") + count,
                          "floes.1.count: needs more than 10 million floes"});
}

TEST_CASE("a floe inside the hull at the start is named", "[cli][errors]") {
    const Workshop w;
    make_case_3d(w);
    check_refused(w, {"icesolve case.cfg --set hull.position=[-4,0,0]",
                      "lies wholly inside the hull: they overlap by"});
}

TEST_CASE("a time step in which bodies may tunnel is warned of, before and after the run",
          "[cli]") {
    const Workshop w;
    make_case_3d(w);
    // spheres of 0.1 m radius: 0.2 m in 0.05 s are 4 m/s
    const std::string fast =
        "icesolve case.cfg --set simulation.time_step=0.05 --set contact.crushing_pressure=inf "
        "--out r --overwrite";
    const Result slow = w.run(fast + " --set hull.speed=1");
    CHECK(slow.code == 0);
    CHECK_THAT(slow.err, !Catch::Contains("pass through"));
    const Result r = w.run(fast + " --set hull.speed=5 --set simulation.duration=0.5");
    CAPTURE(r.err);
    CHECK(r.code == 0);
    CHECK_THAT(r.err, Catch::Contains("the ship moves at 5 m/s, but bodies may pass through each "
                                      "other above 4 m/s") &&
                          Catch::Contains("lower simulation.time_step to 0.04 s"));
    CHECK_THAT(r.err, Catch::Contains("the hull and floe 1 met at "));
    const auto warnings = read_summary(w / "r/summary.json").warnings;
    CHECK(std::count_if(warnings.begin(), warnings.end(), [](const Warning& warning) {
              return warning.text.find("pass through each other") != std::string::npos;
          }) == 2);
}

TEST_CASE("a case of a million lines is read, or refused with a message of a page",
          "[cli][errors]") {
    const Workshop w;
    make_case_3d(w);
    const std::string good = slurp(w / "case.cfg");
    w.write("comments.cfg", repeat("# a line that says nothing\n", 1000000) + good);
    CHECK(w.run("icesolve comments.cfg --check").code == 0);

    std::string rows = "[[0, 0.5]";
    for (int k = 1; k < 1000000; ++k) rows += ",\n[" + std::to_string(k) + ", 0.5]";
    std::string table = good;
    table.replace(table.find("speed = 0.5"), 11, "speed_table = " + rows + "]");
    w.write("table.cfg", table);
    CHECK(w.run("icesolve table.cfg --check").code == 0);

    std::string keys;
    for (int k = 0; k < 1000000; ++k) keys += "wrong_" + std::to_string(k) + " = 1\n";
    w.write("keys.cfg", keys + good);
    check_refused(w, {"icesolve keys.cfg", "1000000 mistakes"});
    check_refused(w, {"icesolve keys.cfg", "and 999980 more"});

    w.write("groups.cfg", good + repeat("[[floes]]\nspheres = \"floe.h5\"\n\n\n", 250000));
    check_refused(w, {"icesolve groups.cfg", "more than 10000 [[floes]] tables"});
    w.write("line.cfg", good + "[drag]\ny = \"" + repeat("a", 1000000) + "\"\n");
    check_refused(w, {"icesolve line.cfg", "unknown key"});
    w.write("deep.cfg", good + "[x]\ny = " + repeat("[", 1000000));
    check_refused(w, {"icesolve deep.cfg", "nested"});
    w.write("large.cfg", repeat("# 64 MB\n", 8 << 20) + good);
    check_refused(w, {"icesolve large.cfg", "too large for a case file (64 MB)"});
}
