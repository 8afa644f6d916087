// SPDX-License-Identifier: GPL-3.0-or-later
// spherize and icesolve as a user meets them.
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <thread>

#include "common/formats/run_file.hpp"
#include "common/formats/spheres_file.hpp"
#include "common/formats/summary_file.hpp"

using namespace ice;
namespace fs = std::filesystem;

namespace {

struct Result {
    int code;
    std::string out, err;
};

std::string slurp(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
}

// A folder of its own for every test, removed at the end.
class Workshop {
public:
    Workshop() {
        static int number = 0;
        folder_ = fs::temp_directory_path() /
                  ("ice-cli-" + std::to_string(::getpid()) + "-" + std::to_string(++number));
        fs::create_directories(folder_);
    }
    ~Workshop() { fs::remove_all(folder_); }

    fs::path operator/(const std::string& name) const { return folder_ / name; }

    Result run(const std::string& command) const {
        const fs::path out = folder_ / "out.txt", err = folder_ / "err.txt";
        const std::string line = "cd '" + folder_.string() + "' && " ICE_BIN "/" + command + " >'" +
                                 out.string() + "' 2>'" + err.string() + "'";
        const int status = std::system(line.c_str());
        Result r{WIFEXITED(status) ? WEXITSTATUS(status) : -1, slurp(out), slurp(err)};
        fs::remove(out);
        fs::remove(err);
        return r;
    }

    void write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name) << text;
    }

    // hull and floe sets of the paper's 2D case and a short case
    void make_case(const std::string& extra = "") const {
        REQUIRE(run("spherize " ICE_MESHES "/paper-hull-2d.obj --slice y=0 -o hull.h5 -q").code ==
                0);
        REQUIRE(run("spherize " ICE_MESHES "/paper-floe-2d.obj --slice y=0 -o floe.h5 -q").code ==
                0);
        write("case.cfg", R"(title = "short"
[simulation]
dimension = 2
duration = 3.0
time_step = 0.005
[hull]
spheres = "hull.h5"
position = [-9.6, 0, 0]
speed = 1.0
[[floes]]
spheres = "floe.h5"
count = [5, 1]
origin = [0.05, 0]
[output]
track = [1]
average_from = 1.0
)" + extra);
    }

    std::vector<std::string> files() const {
        std::vector<std::string> names;
        for (const auto& entry : fs::recursive_directory_iterator(folder_))
            if (entry.is_regular_file())
                names.push_back(fs::relative(entry.path(), folder_).string());
        std::sort(names.begin(), names.end());
        return names;
    }

private:
    fs::path folder_;
};

}  // namespace

TEST_CASE("spherize on the paper's floe gives exactly 240 spheres and a certificate", "[cli]") {
    const Workshop w;
    const Result r = w.run("spherize " ICE_MESHES
                           "/paper-floe-3d.obj -r 0.05 --arrangement lattice --json report.json");
    CHECK(r.code == 0);
    CHECK_THAT(r.out, Catch::Contains("240 spheres"));
    const SphereSet set = read_spheres(w / "paper-floe-3d.spheres.h5");
    CHECK(set.size() == 240);
    CHECK(set.solid.volume == Approx(0.24).epsilon(1e-12));
    CHECK(set.solid.inertia(0, 0) == Approx(0.24 / 12 * (0.64 + 0.09)).epsilon(1e-12));
    CHECK(set.source_mesh == "paper-floe-3d.obj");
    CHECK(set.source_sha256.size() == 64);
    CHECK_THAT(set.command_line, Catch::Contains("--arrangement lattice"));
    const auto json = read_json_numbers(w / "report.json");
    CHECK(json.at("spheres") == 240);
    CHECK(json.at("volume_m3") == Approx(0.24));
    CHECK(json.at("protrusion_max_m") < 1e-9);
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
    CHECK(read_json_numbers(w / "floe.chrono.json").at("mass_kg") == Approx(216).epsilon(1e-12));
    const Result given = w.run(call + " --density 917");
    CHECK_THAT(given.out, !Catch::Contains("density: 900"));
    CHECK(read_json_numbers(w / "floe.chrono.json").at("mass_kg") ==
          Approx(0.24 * 917).epsilon(1e-12));
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
    refuses("", "mesh is required");
    refuses("open.obj --radius -1", "--radius");
    refuses("open.obj --frobnicate", "frobnicate");
    refuses(ICE_MESHES "/paper-floe-3d.obj -r 0.2", "the largest that fits has 0.15 m");
    refuses(ICE_MESHES "/paper-floe-3d.obj --slice z=0", "--slice y=0");
    refuses(ICE_MESHES "/paper-floe-3d.obj --slice y=5", "does not cut");
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
    CHECK(w.files() ==
          std::vector<std::string>{"check.json", "cut.obj", "deck.obj", "side.json", "side.obj"});
}

TEST_CASE("spherize into a folder that does not exist fails with exit code 1", "[cli][errors]") {
    const Workshop w;
    const Result r = w.run("spherize " ICE_MESHES "/paper-floe-3d.obj -r 0.05 -o none/set.h5");
    CHECK(r.code == 1);
    CHECK_THAT(r.err, Catch::Contains("none/set.h5"));
}

TEST_CASE("icesolve writes the run folder of the contract", "[cli]") {
    const Workshop w;
    w.make_case();
    const Result r = w.run("icesolve case.cfg");
    CAPTURE(r.err);
    REQUIRE(r.code == 0);
    CHECK(r.out.empty());
    CHECK_THAT(r.err, Catch::Contains("resistance"));
    for (const char* name :
         {"run.h5", "forces.csv", "floe_1.csv", "summary.json", "case.resolved.cfg", "run.log"})
        CHECK(fs::exists(w / ("results/case/" + std::string(name))));
    for (const std::string& name : w.files()) CHECK(name.find(".part") == std::string::npos);

    std::ifstream forces(w / "results/case/forces.csv");
    std::string header, row;
    std::getline(forces, header);
    CHECK(header ==
          "time_s,contact_fx_N,contact_fy_N,contact_fz_N,friction_fx_N,friction_fy_N,friction_fz_N,"
          "contacts,moving_floes,max_overlap_m,kinetic_energy_J");
    int rows = 0;
    while (std::getline(forces, row)) ++rows;
    CHECK(rows == 600);

    const RunData run = read_run(w / "results/case/run.h5");
    CHECK(run.history.size() == 600);
    CHECK(run.frames.size() == 31);  // 0, 0.1, ... 3.0 s
    CHECK(run.header.body_shape.size() == 5);
    CHECK(run.tracks.size() == 1);

    const Summary s = read_summary(w / "results/case/summary.json");
    CHECK(s.status == "completed");
    CHECK(s.steps == 600);
    // the summary's mean is that of the history
    double mean = 0.0, count = 0.0;
    for (const HistoryRow& h : run.history)
        if (h.time >= 1.0 - 1e-9) {
            mean -= h.contact_force.x() + h.friction_force.x();
            count += 1.0;
        }
    CHECK(s.resistance.mean == Approx(mean / count).epsilon(1e-6));  // CSV-free: same doubles
}

TEST_CASE("the same case gives the same state hash for 1, 2, 3 and 4 threads",
          "[cli][determinism]") {
    const Workshop w;
    w.make_case();
    std::set<std::uint64_t> hashes;
    for (const int threads : {1, 2, 3, 4}) {
        REQUIRE(w.run("icesolve case.cfg -q --out r --threads " + std::to_string(threads)).code ==
                0);
        hashes.insert(read_summary(w / "r/summary.json").state_hash);
    }
    CHECK(hashes.size() == 1);
}

TEST_CASE("a 3D field of 600 moving floes gives the same hash for 1, 2 and 3 threads",
          "[cli][determinism]") {
    // large enough that every loop that threads share really is shared
    const Workshop w;
    REQUIRE(w.run("spherize " ICE_MESHES "/paper-hull-3d.obj -s 0.2 -q -o hull.h5").code == 0);
    REQUIRE(w.run("spherize " ICE_MESHES
                  "/paper-floe-3d.obj -r 0.05 --arrangement lattice -q -o floe.h5")
                .code == 0);
    w.write("field.cfg", R"([simulation]
duration = 0.4
[hull]
spheres = "hull.h5"
position = [-9.3, 0, 0]
speed = 1.0
[[floes]]
spheres = "floe.h5"
count = [30, 20]
gap = [0.0, 0.0]
hold = "never"
)");
    std::set<std::uint64_t> hashes;
    double contacts = 0.0;
    for (const int threads : {1, 2, 3}) {
        REQUIRE(w.run("icesolve field.cfg -q --out r --threads " + std::to_string(threads)).code ==
                0);
        const Summary s = read_summary(w / "r/summary.json");
        hashes.insert(s.state_hash);
        contacts = s.contacts_max;
    }
    CHECK(contacts > 0.0);
    CHECK(hashes.size() == 1);
}

TEST_CASE("a run that fails on the way says so in its summary and leaves no .part files",
          "[cli][errors]") {
    const Workshop w;
    w.make_case("[environment]\ngravity = 0.0\n");
    const Result r = w.run(
        "icesolve case.cfg --set floes.hold=never --set floes.pattern=single "
        "--set floes.position=[5,0,-0.16] --set floes.velocity=[50,0,0] --set drag.model=none "
        "--set simulation.duration=999000 --set simulation.time_step=1 "
        "--set output.track=[] --set output.history_every=1000 --set output.frames_every=10000");
    CAPTURE(r.err);
    CHECK(r.code == 1);
    CHECK_THAT(r.err, Catch::Contains("step") && Catch::Contains("floe 1"));
    CHECK(read_summary(w / "results/case/summary.json").status == "failed");
    for (const std::string& name : w.files()) CHECK(name.find(".part") == std::string::npos);
}

TEST_CASE("an old run's files do not survive a new run into the same folder", "[cli]") {
    const Workshop w;
    w.make_case();
    REQUIRE(w.run("icesolve case.cfg -q").code == 0);
    REQUIRE(fs::exists(w / "results/case/floe_1.csv"));
    w.write("results/case/run.h5.part", "old");
    REQUIRE(w.run("icesolve case.cfg -q --set output.track=[]").code == 0);
    CHECK_FALSE(fs::exists(w / "results/case/floe_1.csv"));
    CHECK_FALSE(fs::exists(w / "results/case/run.h5.part"));
}

TEST_CASE("floes that overlap at the start are named in the warnings", "[cli]") {
    const Workshop w;
    w.make_case();
    const Result r = w.run("icesolve case.cfg --set hull.position=[-8,0,0]");
    CHECK(r.code == 0);
    CHECK_THAT(r.err, Catch::Contains("the hull and floe") && Catch::Contains("overlap by"));
}

TEST_CASE("the resolved case repeats the run to the same bits", "[cli][determinism]") {
    const Workshop w;
    w.make_case();
    REQUIRE(w.run("icesolve case.cfg -q --out a --set contact.restitution=0.1").code == 0);
    REQUIRE(w.run("icesolve a/case.resolved.cfg -q --out b").code == 0);
    CHECK(read_summary(w / "a/summary.json").state_hash ==
          read_summary(w / "b/summary.json").state_hash);
}

TEST_CASE("option --hash-every prints a line of step and hash", "[cli]") {
    const Workshop w;
    w.make_case();
    const Result r = w.run("icesolve case.cfg -q --hash-every 200");
    CHECK(std::count(r.out.begin(), r.out.end(), '\n') == 3);
    CHECK(r.out.starts_with("200 "));
}

TEST_CASE("option --json prints the summary on stdout, and only that", "[cli]") {
    const Workshop w;
    w.make_case();
    const Result r = w.run("icesolve case.cfg -q --json");
    CHECK(r.err.empty());
    CHECK(r.out == slurp(w / "results/case/summary.json"));
    CHECK_THAT(r.out, Catch::Contains("\"schema\": \"icesolve-summary/1\""));
}

TEST_CASE("option --check builds everything and writes nothing", "[cli]") {
    const Workshop w;
    w.make_case();
    const Result r = w.run("icesolve case.cfg --check");
    CHECK(r.code == 0);
    CHECK_THAT(r.err, Catch::Contains("5 floes"));
    CHECK_FALSE(fs::exists(w / "results"));
}

TEST_CASE("bad cases end with exit code 2, name the place and leave nothing", "[cli][errors]") {
    const Workshop w;
    w.make_case();
    const auto refuses = [&](const std::string& arguments, const std::string& words) {
        const Result r = w.run("icesolve " + arguments);
        CAPTURE(arguments, r.err);
        CHECK(r.code == 2);
        CHECK_THAT(r.err, Catch::Contains(words));
    };
    refuses("missing.cfg", "missing.cfg: case file not found");
    refuses("case.cfg --set hull.sped=1", "did you mean 'hull.speed'?");
    refuses("case.cfg --set simulation.dimension=3", "2D set in a case of dimension 3");
    refuses("case.cfg --set output.track=[6]", "floe 6 does not exist");
    refuses("case.cfg --set ice.density=1100", "no floating equilibrium");
    refuses("case.cfg --nonsense", "nonsense");
    refuses("--explain contact.frction", "--explain");
    refuses("", "no case file");
    std::ofstream(w / "hull.h5") << "not HDF5";
    refuses("case.cfg", "hull.h5");
    CHECK_FALSE(fs::exists(w / "results"));
}

TEST_CASE("option --explain, --print-schema and --print-defaults print and end with 0", "[cli]") {
    const Workshop w;
    CHECK_THAT(w.run("icesolve --explain contact.restitution").out,
               Catch::Contains("default 0.3") && Catch::Contains("from 0 to 1"));
    CHECK_THAT(w.run("icesolve --print-schema").out, Catch::Contains("\"simulation\""));
    CHECK_THAT(w.run("icesolve --print-defaults").out, Catch::Contains("[contact]"));
    for (const char* program : {"spherize", "icesolve", "icepost"}) {
        CHECK(w.run(std::string(program) + " --version").code == 0);
        CHECK_THAT(w.run(std::string(program) + " --help").out, Catch::Contains("Exit codes"));
    }
}

TEST_CASE("an interrupted run keeps what was done and ends with 130", "[cli]") {
    const Workshop w;
    w.make_case();
    const std::string folder = (w / "").string();
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        if (chdir(folder.c_str()) != 0) _exit(99);
        execl(ICE_BIN "/icesolve", "icesolve", "case.cfg", "-q", "--set",
              "simulation.duration=5000", "--set", "output.frames_every=10", "--out", "r",
              static_cast<char*>(nullptr));
        _exit(99);
    }
    // the run is under way once its files are there
    for (int k = 0; k < 200 && !fs::exists(w / "r/forces.csv.part"); ++k)
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    kill(child, SIGINT);
    int status = 0;
    waitpid(child, &status, 0);
    REQUIRE(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 130);
    const Summary s = read_summary(w / "r/summary.json");
    CHECK(s.status == "interrupted");
    CHECK(s.steps > 0);
    CHECK(read_run(w / "r/run.h5").history.size() == static_cast<std::size_t>(s.steps));
}
