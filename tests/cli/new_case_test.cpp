// SPDX-License-Identifier: GPL-3.0-or-later
// A first case of one's own: what --check says, what --new writes, and which answers come out.
#include <cmath>

#include "common/formats/summary_file.hpp"
#include "tests/cli/workshop.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using namespace ice::test;

namespace {

// The 100 m icebreaker as CAD gives it: STL, in millimetres, the keel at z = 0 (ASCII, unscaled
// normals, which readers do without).
std::string hull_stl() {
    std::ifstream in(ICE_MESHES "/icebreaker-100m.obj");
    std::vector<std::array<double, 3>> vertices;
    std::string out = "solid hull\n", word;
    for (std::string text; std::getline(in, text);) {
        std::istringstream words(text);
        words >> word;
        if (word == "v") {
            std::array<double, 3> v{};
            words >> v[0] >> v[1] >> v[2];
            vertices.push_back({1e3 * v[0], 1e3 * v[1], 1e3 * (v[2] + 8.0)});
        } else if (word == "f") {
            out += "facet normal 0 0 0\nouter loop\n";
            for (std::string corner; words >> corner;) {
                const auto& v = vertices.at(std::stoul(corner) - 1);
                std::ostringstream row;
                row.precision(10);
                row << "vertex " << v[0] << ' ' << v[1] << ' ' << v[2] << '\n';
                out += row.str();
            }
            out += "endloop\nendfacet\n";
        }
    }
    return out + "endsolid hull\n";
}

// 80 % of floes of 0.8 m thickness in a strip that the ship goes a third of its length into
const char* const kIce =
    "pattern = \"voronoi\"\n[ice]\nthickness = 0.8\n[spheres]\nradius = 0.2\nspacing = 0.6\n"
    "[area]\nsize = [80, 60]\n[floes]\nconcentration = 0.8\nmean_size = 8\n";

// Required keys only, but for what `hull` and `contact` add.
std::string required_keys(const std::string& hull, const std::string& more = "") {
    return "[simulation]\nduration = 20\ntime_step = 0.02\n[hull]\nspheres = \"hull.h5\"\n"
           "speed = \"5 kn\"\n" +
           hull + "\n[[floes]]\npattern = \"file\"\nfile = \"ice.h5\"\n" + more;
}

// A drafted case with the level ice of its comments in the place of its floes.
std::string with_sheet(const std::string& drafted) {
    std::istringstream lines(drafted);
    std::string out;
    bool floes = false, sheet = false;
    for (std::string text; std::getline(lines, text);) {
        if (text == "[[floes]]" || text.starts_with("# Unbroken ice")) {
            sheet = !(floes = text == "[[floes]]");
            continue;
        }
        if (text.starts_with("[")) floes = sheet = false;
        if (!floes)
            out += (sheet ? text.substr(std::min<std::size_t>(2, text.size())) : text) + '\n';
    }
    return out;
}

double mean_of(const Workshop& w, const std::string& name, const std::string& text) {
    w.write(name + ".cfg", text);
    const Result r = w.run("icesolve " + name + ".cfg --no-report --out " + name);
    CAPTURE(name, r.err);
    REQUIRE(r.code == 0);
    return read_summary(w / name / "summary.json").resistance.mean;
}

}  // namespace

TEST_CASE("the same ship in the same ice gives one answer, or an error that names the draught",
          "[cli]") {
    const Workshop w;
    w.write("ship.stl", hull_stl());
    w.write("ice.toml", kIce);
    // spheres of 0.7 m: what differs between the runs is which keys they state
    REQUIRE(w.run("spherize ship.stl -r 0.7 -s 1.0 --mode surface -o hull.h5 -q").code == 0);
    REQUIRE(w.run("icefield ice.toml -q").code == 0);

    w.write("glides.cfg", required_keys("position = [-102, 0, 0]"));
    for (const char* how : {" --check", " --out glides"}) {
        const Result r = w.run(std::string("icesolve glides.cfg") + how);
        CHECK(r.code == 2);
        CHECK_THAT(r.err, Catch::Contains("a draught of 0 m") &&
                              Catch::Contains("give hull.draught in its place") &&
                              Catch::Contains("between 0 and 13 m"));
    }

    const double deep = mean_of(w, "deep", required_keys("position = [-102, 0, -8]"));
    const double draught =
        mean_of(w, "draught", required_keys("position = [-102, 0]\ndraught = 8"));
    const double crushed = mean_of(
        w, "crushed",
        required_keys("position = [-102, 0, -8]", "[contact]\ncrushing_pressure = \"1 MPa\"\n"));
    const double stated =
        mean_of(w, "stated",
                required_keys("position = [-102, 0, -8]",
                              "hold = \"never\"\n[contact]\ncrushing_pressure = \"1 MPa\"\n"));
    CAPTURE(deep, draught, crushed, stated);
    CHECK(stated > 0.0);
    for (const double mean : {deep, draught, crushed}) CHECK(mean == Near(stated).epsilon(0.15));
}

TEST_CASE("the option --check says draught, displacement, travel, steps, clearance, and draws",
          "[cli]") {
    const Workshop w;
    REQUIRE(w.run("spherize " ICE_MESHES "/paper-hull-3d.obj -r 0.1 -s 0.2 -o hull.h5 -q").code ==
            0);
    w.write("ice.toml",
            "pattern = \"grid\"\n[ice]\nthickness = 0.3\n[spheres]\nradius = 0.1\nspacing = 0.3\n"
            "[floes]\nsize = [1, 1]\ncount = [10, 3]\ngap = [0.1, 0.1]\n[edges]\nbreadth = 1\n");
    REQUIRE(w.run("icefield ice.toml -q").code == 0);
    w.write("case.cfg", required_keys("draught = 1.44\nposition = [-10, 0]"));
    const Result r = w.run("icesolve case.cfg --set hull.speed=0.5 --check --picture start.svg");
    CAPTURE(r.err);
    REQUIRE(r.code == 0);
    for (const char* words :
         {"draught 1.44 m of", "displacement 20.21 t", "half entrance 70 deg", "30 floes of 1.13",
          "held: never (loose), always (unbroken)", "10 m, 1.05 ship lengths, in 1000 steps",
          "clearance", "hull 0.1 m, 0.2 m apart", "crushing 1 MPa"})
        CHECK_THAT(r.err, Catch::Contains(words));
    CHECK_THAT(slurp(w / "start.svg"), Catch::StartsWith("<svg"));
    const auto names = w.files();
    CHECK(std::count(names.begin(), names.end(), "case.cfg") == 1);
    CHECK(names.size() == 6);  // sets, specification, case, picture, flow: no run folder

    const Result bad = w.run("icesolve case.cfg --check --picture start.jpg");
    CHECK(bad.code == 2);
    CHECK_THAT(bad.err, Catch::Contains("start.jpg"));
    CHECK(w.run("icesolve case.cfg --picture start.svg").code == 2);
}

TEST_CASE("the option --new writes a case that runs as it is, from a mesh and a specification",
          "[cli]") {
    const Workshop w;
    fs::create_directories(w / "my ship");
    fs::copy_file(ICE_MESHES "/paper-hull-3d.obj", w / "my ship" / "hull.obj");
    w.write("my ship/ice.toml",
            "pattern = \"grid\"\n[ice]\nthickness = 0.3\n[spheres]\nradius = 0.1\nspacing = 0.3\n"
            "[floes]\nsize = [1, 1]\ncount = [23, 3]\ngap = [0.1, 0.1]\n[edges]\nbreadth = 1\n");
    const Result r =
        w.run("icesolve --new 'my ship/hull.obj' 'my ship/ice.toml' -o 'my ship/first.cfg'");
    CAPTURE(r.err);
    REQUIRE(r.code == 0);
    const std::string text = slurp(w / "my ship" / "first.cfg");
    CAPTURE(text);
    CHECK_THAT(text, Catch::StartsWith("#:schema case.schema.json\n"));
    CHECK_THAT(text, Catch::Contains("spheres = \"hull.spheres.h5\"") &&
                         Catch::Contains("file = \"ice.h5\"") &&
                         Catch::Contains("draught = 1.44") && Catch::Contains("CHECK") &&
                         Catch::Contains("hold = \"never\""));
    CHECK(w.files().size() == 5);

    // from any folder, without a warning: the ship meets the ice and stays in it
    const Result check = w.run("icesolve 'my ship/first.cfg' --check");
    CHECK(check.code == 0);
    CHECK_THAT(check.err, Catch::Contains(": good, ") && Catch::Contains("averaged over 1.2"));
    // a ship length in the ice before, so that floes lie along the whole hull
    CHECK_THAT(text,
               Catch::Contains("s: 1.00 ship lengths in the ice; averages over the last 1.2"));
    CHECK_THAT(r.err, !Catch::Contains("the field is short"));
    const Result run = w.run(
        "icesolve 'my ship/first.cfg' --set simulation.duration=1 --set output.average_from=0.5 "
        "--no-report --out run");
    CAPTURE(run.err);
    CHECK(run.code == 0);

    // nothing is replaced
    const Result again = w.run("icesolve --new 'my ship/hull.obj' -o 'my ship/first.cfg'");
    CHECK(again.code == 2);
    CHECK_THAT(again.err, Catch::Contains("exists already"));
    const Result spheres = w.run("icesolve --new 'my ship/hull.obj' -o 'my ship/second.cfg'");
    CHECK(spheres.code == 2);
    CHECK_THAT(spheres.err, Catch::Contains("hull.spheres.h5") &&
                                Catch::Contains("give it in place of the mesh"));
    CHECK(slurp(w / "my ship" / "first.cfg") == text);
    CHECK(w.files().size() >= 5);
}

TEST_CASE("the option --new without ice drafts some of the ship's size", "[cli]") {
    const Workshop w;
    w.write("ship.stl", hull_stl());
    const Result r = w.run("icesolve --new ship.stl");
    CAPTURE(r.err);
    REQUIRE(r.code == 0);
    CHECK_THAT(slurp(w / "ice.toml"),
               Catch::Contains("thickness = 1") && Catch::Contains("size = [250, "));
    CHECK_THAT(slurp(w / "ship.cfg"),
               Catch::Contains("draught = 7.8") && Catch::Contains("CHECK: 0.6 of the depth"));
    const Result check = w.run("icesolve ship.cfg --check");
    CHECK(check.code == 0);
    CHECK_THAT(check.err, Catch::Contains(": good, "));

    // the level ice that its comments offer, in the place of the floes, is a case, too
    const std::string level = with_sheet(slurp(w / "ship.cfg"));
    CAPTURE(level);
    CHECK_THAT(level, Catch::Contains("\n[level_ice]\n") && !Catch::Contains("floes]]"));
    w.write("level.cfg", level);
    const Result unbroken = w.run("icesolve level.cfg --check");
    CAPTURE(unbroken.err);
    CHECK(unbroken.code == 0);
    CHECK_THAT(unbroken.err, Catch::Contains(": good, ") && !Catch::Contains("never meets"));

    // what the file does not say and spherize would guess otherwise: a ship of twice the size
    const Result told = w.run("icesolve --new ship.stl ice.toml -o twice/ship.cfg --scale 0.002");
    CHECK(told.code == 1);
    CHECK_THAT(told.err, Catch::Contains("-o: cannot write twice/ship.cfg: no folder twice"));
    fs::create_directories(w / "twice");
    const Result twice =
        w.run("icesolve --new ship.stl ice.h5 -o twice/ship.cfg --scale 0.002 --up z --forward +x");
    CAPTURE(twice.err);
    REQUIRE(twice.code == 0);
    CHECK_THAT(slurp(w / "twice/ship.cfg"), Catch::Contains("draught = 15.6"));
    CHECK_THAT(r.err, !Catch::Contains("the field is short"));
    // a field of 2.5 lengths is one of 1.25 for it
    CHECK_THAT(twice.err, Catch::Contains("the field is short: forces are averaged over 0.") &&
                              Catch::Contains("area.size of") && Catch::Contains("one or more"));
    const Result set = w.run("icesolve --new ship.spheres.h5 ice.h5 -o set.cfg --units mm");
    CHECK(set.code == 2);
    CHECK_THAT(set.err, Catch::Contains("--units: says how to read a mesh, but ship.spheres.h5") &&
                            Catch::Contains("leave it out, or give the mesh"));
    fs::create_directories(w / "sideways");
    const Result sideways = w.run("icesolve --new ship.stl ice.h5 -o sideways/ship.cfg --up x");
    CHECK(sideways.code == 2);
    CHECK_THAT(sideways.err, Catch::Contains("spherize: error: --up"));
    CHECK(fs::is_empty(w / "sideways"));
    CHECK(w.run("icesolve ship.cfg --check --units mm").code == 2);  // without --new

    const Result lost = w.run("icesolve --new lost.stl");
    CHECK(lost.code == 2);
    CHECK_THAT(lost.err, Catch::Contains("hull not found"));
}
