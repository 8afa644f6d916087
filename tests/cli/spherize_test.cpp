// SPDX-License-Identifier: GPL-3.0-or-later
// spherize as a user meets it: exit codes, messages, files left behind.
//
// Tolerances: 1e-12 is rounding of sums over a box's triangles; 1e-9 m that of its spheres' places,
// with a reserve.
#include <map>

#include "common/formats/spheres_file.hpp"
#include "common/formats/summary_file.hpp"
#include "tests/cli/workshop.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using namespace ice::test;

TEST_CASE("spherize on the paper's floe gives exactly 240 spheres and a certificate", "[cli]") {
    const Workshop w;
    const Result r = w.run("spherize " ICE_MESHES
                           "/paper-floe-3d.obj -r 0.05 --arrangement lattice --json report.json");
    CHECK(r.code == 0);
    CHECK_THAT(r.out, Catch::Contains("240 spheres"));
    const SphereSet set = read_spheres(w / "paper-floe-3d.spheres.h5");
    CHECK(set.size() == 240);
    CHECK(set.solid.volume == Near(0.24).epsilon(1e-12));
    CHECK(set.solid.inertia(0, 0) == Near(0.24 / 12 * (0.64 + 0.09)).epsilon(1e-12));
    CHECK(set.source_mesh == "paper-floe-3d.obj");
    CHECK(set.source_sha256.size() == 64);
    CHECK_THAT(set.command_line, Catch::Contains("--arrangement lattice"));
    const auto json = read_json_numbers(w / "report.json");
    CHECK(json.at("spheres") == 240);
    CHECK(json.at("volume_m3") == Near(0.24));
    CHECK(json.at("protrusion_max_m") < tolerance(1e-9));
}

TEST_CASE("spherize overwrites neither the mesh nor one result by another", "[cli][errors]") {
    const Workshop w;
    const std::string mesh = slurp(ICE_MESHES "/paper-floe-3d.obj");
    w.write("floe.obj", mesh);
    const auto refuses = w.refusing("spherize ");
    refuses("floe.obj -o floe.obj", "--output: would overwrite the mesh");
    refuses("floe.obj --json ./floe.obj", "--json: would overwrite the mesh");
    refuses("floe.obj -o set.h5 --json set.h5", "--json: would overwrite --output");
    refuses("floe.obj -o set.h5 --json set.vtp --export vtp", "--export: would overwrite --json");
    refuses("floe.obj -o set.vtp --export vtp", "--export: would overwrite --output");
    CHECK(w.files() == std::vector<std::string>{"floe.obj"});
    CHECK(slurp(w / "floe.obj") == mesh);
}

TEST_CASE("spherize names an output's folder that is missing before it works", "[cli][errors]") {
    const Workshop w;
    w.write("text.obj", "this is no mesh\n");  // never read
    for (const char* how : {"-o no/such/f", "-o f --json no/such/f", "-o no/such/f --export csv"}) {
        const Result r = w.run(std::string("spherize text.obj ") + how);
        CAPTURE(how, r.err);
        CHECK(r.code == 1);
        CHECK_THAT(r.err, Catch::Contains("cannot write no/such/f: no folder no/such\n") &&
                              Catch::Contains("make the folder, or write to another one") &&
                              !Catch::Contains(".part"));
    }
    CHECK(w.files() == std::vector<std::string>{"text.obj"});
}

TEST_CASE("spherize writes the same bytes for any number of threads", "[cli][determinism]") {
    // by the environment, because the file keeps the command line
    const Workshop w;
    const auto bytes = [&](const std::string& threads, const std::string& arguments) {
        REQUIRE(::setenv("OMP_NUM_THREADS", threads.c_str(), 1) == 0);
        const Result r = w.run("spherize " ICE_MESHES "/" + arguments + " -o set.h5 --export vtp");
        ::unsetenv("OMP_NUM_THREADS");
        REQUIRE(r.code == 0);
        return slurp(w / "set.h5") + slurp(w / "set.vtp");
    };
    for (const char* arguments :
         {"icebreaker-100m.obj -r 0.4", "paper-hull-3d.obj -s 0.05",
          "paper-floe-3d.obj -r 0.02 --arrangement lattice", "paper-hull-2d.obj --slice y=0"}) {
        CAPTURE(arguments);
        const std::string one = bytes("1", arguments);
        CHECK(bytes("2", arguments) == one);
        CHECK(bytes("5", arguments) == one);
    }
}

TEST_CASE("equal calls of spherize write equal bytes", "[cli]") {
    const Workshop w;
    const std::string call =
        "spherize " ICE_MESHES "/paper-hull-3d.obj -s 0.2 -q -o set.h5 --threads ";
    REQUIRE(w.run(call + "2").code == 0);
    const std::string first = slurp(w / "set.h5");
    REQUIRE(w.run(call + "2").code == 0);
    CHECK(slurp(w / "set.h5") == first);
}

TEST_CASE("spherize names half a hull and says what it took for units and axes", "[cli]") {
    // triangular sections, 2 x 2 m aft and 0.5 x 0.5 m ahead, 10 m apart: a frustum of
    // 10 / 3 (2 + sqrt(2 x 0.125) + 0.125) = 8.75 m3, in millimetres
    const std::string open_half =
        "v 0 0 0\nv 10000 0 1500\nv 0 0 2000\nv 10000 0 2000\nv 0 2000 2000\nv 10000 500 2000\n"
        "f 3 4 6 5\nf 1 5 6 2\nf 1 3 5\nf 2 6 4\n";
    const Workshop w;
    w.write("open.obj", open_half);
    w.write("closed.obj", open_half + "f 1 2 4 3\n");
    const Result closed = w.run("spherize closed.obj --check --json report.json");
    CHECK(closed.code == 0);
    CHECK_THAT(closed.out,
               Catch::Contains("8.75 m3") && Catch::Matches("(.|\n)*assumed +up: z(.|\n)*"));
    CHECK_THAT(closed.err, Catch::Contains("everything is on the port side of y = 0, 2 triangles "
                                           "close it there): give --mirror y"));
    CHECK_THAT(slurp(w / "report.json"),
               Catch::Contains("mm, because the solid would be 10000 m long in metres"));
    const Result open = w.run("spherize open.obj --check --repair strict");
    CHECK(open.code == 2);
    CHECK_THAT(open.err, Catch::Contains("4 open edges lie in that plane): give --mirror y"));
    for (const char* name : {"open.obj", "closed.obj"}) {
        const Result whole = w.run("spherize --check --mirror y --units mm " + std::string(name));
        CHECK_THAT(whole.out,
                   Catch::Contains("17.5 m3") && !Catch::Matches("(.|\n)*assumed +units(.|\n)*"));
        CHECK(whole.err.empty());
    }
}

TEST_CASE("hull regions survive from the OBJ groups to the spheres", "[cli]") {
    const Workshop w;
    REQUIRE(w.run("spherize " ICE_MESHES "/paper-hull-3d.obj -s 0.2 -q -o set.h5").code == 0);
    const SphereSet set = read_spheres(w / "set.h5");
    std::map<std::string, double> area;
    for (std::size_t k = 0; k < set.size(); ++k)
        area[set.mesh.region_names[static_cast<std::size_t>(set.region(k))]] += set.area(k);
    for (const char* name : {"bow", "bottom", "side", "stern", "propeller", "deck"})
        CHECK(area[name] > 0.5);
}

TEST_CASE("spherize exports with the mass at a density that it says and stores", "[cli]") {
    const Workshop w;
    const std::string call = "spherize " ICE_MESHES
                             "/paper-floe-3d.obj -r 0.05 --arrangement lattice -o floe.h5 "
                             "--export chrono --export vtp";
    const Result assumed = w.run(call);
    CHECK(assumed.code == 0);
    for (const char* words : {"density: 900 kg/m3", "floe.chrono.json", "floe.vtp"})
        CHECK_THAT(assumed.out, Catch::Contains(words));
    // the paper's floe of 1 x 0.8 x 0.3 m
    CHECK(read_json_numbers(w / "floe.chrono.json").at("mass_kg") == Near(216).epsilon(1e-12));
    const Result given = w.run(call + " --density 917");
    CHECK_THAT(given.out, !Catch::Contains("density: 900"));
    CHECK(read_json_numbers(w / "floe.chrono.json").at("mass_kg") ==
          Near(0.24 * 917).epsilon(1e-12));
    CHECK(w.files() ==
          std::vector<std::string>{"floe.chrono.csv", "floe.chrono.json", "floe.h5", "floe.vtp"});
}

TEST_CASE("spherize refuses bad meshes by name with exit code 2 and leaves nothing",
          "[cli][errors]") {
    const Workshop w;
    w.write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n");
    w.write("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    w.write("text.obj", "this is no mesh\n");
    const auto refuses = [&](const std::string& arguments, const std::string& words) {
        const Result r = w.run("spherize " + arguments);
        CAPTURE(arguments, r.err);
        CHECK(r.code == 2);
        CHECK_THAT(r.err, Catch::Contains(words));
        CHECK(r.out.empty());
    };
    refuses("open.obj", "open edges");
    refuses("nan.obj", "not a finite number");
    refuses("text.obj", "text.obj");
    refuses("missing.obj", "not found");
    refuses("", "no mesh given");
    refuses("open.obj --radius -1", "--radius");
    refuses("open.obj --frobnicate", "frobnicate");
    refuses(ICE_MESHES "/paper-floe-3d.obj -r 0.2", "give --radius below 0.15 m");
    refuses(ICE_MESHES "/paper-floe-3d.obj --slice z=0", "--slice y=0");
    refuses(ICE_MESHES "/paper-floe-3d.obj --slice y=5", "does not cut");
    refuses(ICE_MESHES "/paper-floe-3d.obj --slice y=nan", "is not y=VALUE");
    refuses(ICE_MESHES "/paper-floe-2d.obj --slice y=0 --export yade", "2D set");
    refuses(ICE_MESHES "/paper-floe-3d.obj --export xyz", "--export");
    refuses(ICE_MESHES "/paper-floe-3d.obj --density 0", "--density");
    CHECK(w.files() == std::vector<std::string>{"nan.obj", "open.obj", "text.obj"});
}

TEST_CASE("spherize --check says what a mesh is and what would be done, and does nothing",
          "[cli]") {
    const Workshop w;
    const std::string sides =
        "f 1 3 2\nf 2 3 4\nf 1 2 5\nf 2 6 5\nf 3 7 4\nf 4 7 8\nf 1 5 3\nf 3 5 7\nf 2 4 6\n"
        "f 4 8 6\n";
    const std::string corners =
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\n";
    w.write("deck.obj", corners + sides);
    const Result deck = w.run("spherize deck.obj --check --json check.json");
    CHECK(deck.code == 0);
    CHECK_THAT(deck.out, Catch::Contains("4 open edges") && Catch::Contains("4 m around") &&
                             Catch::Contains("deck closed by a cap: 1") &&
                             Catch::Contains("closed solid, 12 triangles, 1 m3"));
    CHECK_THAT(slurp(w / "check.json"), Catch::Contains("deck closed by a cap"));

    w.write("box.obj", corners + "f 5 6 7\nf 6 8 7\n" + sides);
    const Result over = w.run("spherize box.obj --up -z --check");
    CHECK(over.code == 0);
    CHECK_THAT(over.out, Catch::Contains("z -1 to "));

    w.write("side.obj", corners + "f 5 6 7\nf 6 8 7\n" + sides.substr(0, sides.size() - 16));
    const Result side = w.run("spherize side.obj --check --json side.json");
    CHECK(side.code == 2);
    CHECK_THAT(side.out, Catch::Contains("4 open edges"));
    CHECK_THAT(side.err, Catch::Contains("too large to guess") && Catch::Contains("--repair wrap"));
    CHECK_THAT(slurp(w / "side.json"), Catch::Contains("too large to guess"));
    CHECK(w.run("spherize deck.obj --repair strict").code == 2);

    // the vertices of a deck without its faces: half a file, not an open deck
    w.write("cut.obj", corners + "v 0.5 0.5 1.5\n" + sides);
    const Result cut = w.run("spherize cut.obj");
    CHECK(cut.code == 2);
    CHECK_THAT(cut.err, Catch::Contains("no face uses its last 1 vertices"));
    CHECK(w.files() == std::vector<std::string>{"box.obj", "check.json", "cut.obj", "deck.obj",
                                                "side.json", "side.obj"});
}

TEST_CASE("spherize into a folder that does not exist fails with exit code 1", "[cli][errors]") {
    const Workshop w;
    const Result r = w.run("spherize " ICE_MESHES "/paper-floe-3d.obj -r 0.05 -o none/set.h5");
    CHECK(r.code == 1);
    CHECK_THAT(r.err, Catch::Contains("none/set.h5"));
}

TEST_CASE("a spacing that leaves the surface open is warned of", "[cli]") {
    const Workshop w;
    const std::string floe = "spherize " ICE_MESHES "/paper-floe-3d.obj -r 0.05 -o x.h5 -s ";
    const Result closed = w.run(floe + "0.15"), open = w.run(floe + "0.2");
    CHECK(closed.code == 0);
    CHECK(closed.err == "");
    CHECK(open.code == 0);
    CHECK_THAT(open.err, Catch::Contains("warning: the surface spheres are 0.2 m apart") &&
                             Catch::Contains("use --spacing 0.15 or less"));
}
