// SPDX-License-Identifier: GPL-3.0-or-later
// icesolve as a user meets it: run folders, hashes, messages, interruption.
//
// Tolerances: 1e-6 is rounding of sums over the rows, with a reserve; 0.5 % of the work is the
// bound of the energy ledger's warning; 1e-12 is that of --verify.
#include <signal.h>

#include <chrono>
#include <set>
#include <thread>

#include "common/formats/run_file.hpp"
#include "common/formats/summary_file.hpp"
#include "tests/cli/workshop.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using namespace ice::test;

TEST_CASE("icesolve writes the run folder of the contract", "[cli]") {
    const Workshop w;
    w.make_case();
    const Result r = w.run("icesolve case.cfg --out results/case");
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
          "contacts,moving_floes,max_overlap_m,kinetic_energy_J,contact_fx_N_per_m,"
          "contact_fy_N_per_m,contact_fz_N_per_m,friction_fx_N_per_m,friction_fy_N_per_m,"
          "friction_fz_N_per_m,kinetic_energy_J_per_m");  // 2D: the old names and the right ones
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
    CHECK_FALSE(s.regions.contains("hull"));  // every part of this mesh has a name
    CHECK(s.regions.contains("bow"));
    // the summary's mean is that of the history
    double mean = 0.0, count = 0.0;
    for (const HistoryRow& h : run.history)
        if (h.time >= 1.0 - 1e-9) {
            mean -= h.contact_force.x() + h.friction_force.x();
            count += 1.0;
        }
    CHECK(s.resistance.mean == Near(mean / count).epsilon(1e-6));  // CSV-free: same doubles
    // the ship pushes with what the ice pushes back: the work is that of the history's forces
    double work = 0.0;
    for (const HistoryRow& h : run.history)
        work -= (h.contact_force.x() + h.friction_force.x()) * 1.0 * 0.005;
    CHECK(s.energy.at("ship_work_J") == Near(work).epsilon(1e-6));
    CHECK(std::abs(s.energy.at("residual_J")) < tolerance(0.005) * s.energy.at("ship_work_J"));
}

TEST_CASE("icesolve --verify finds every step in balance, says so, and changes no bit of the run",
          "[cli]") {
    const Workshop w;
    w.make_case();
    REQUIRE(w.run("icesolve case.cfg -q --out plain").code == 0);
    REQUIRE(w.run("icesolve case.cfg -q --out verified --verify").code == 0);
    const Summary plain = read_summary(w / "plain/summary.json");
    const Summary verified = read_summary(w / "verified/summary.json");
    CHECK(plain.imbalance.empty());
    CHECK(verified.imbalance.size() == 3);
    for (const auto& [kind, worst] : verified.imbalance) {
        CAPTURE(kind);
        CHECK(worst > 0.0);  // it did look: rounding is never exactly zero over 600 steps
        CHECK(worst <= tolerance(1e-12));
    }
    CHECK(plain.state_hash == verified.state_hash);
}

TEST_CASE("a run with too few iterations counts the steps it did not solve", "[cli]") {
    const Workshop w;
    w.make_case();
    REQUIRE(w.run("icesolve case.cfg -q --out few --set contact.iterations=1").code == 0);
    REQUIRE(w.run("icesolve case.cfg -q --out many --set contact.iterations=2000").code == 0);
    const Summary few = read_summary(w / "few/summary.json");
    const Summary many = read_summary(w / "many/summary.json");
    CHECK(few.unconverged_steps > 10 * (1 + many.unconverged_steps));
    CHECK_FALSE(few.warnings.empty());
}

TEST_CASE("the same case gives the same state hash for 1, 2, 3 and 4 threads",
          "[cli][determinism]") {
    const Workshop w;
    w.make_case();
    std::set<std::uint64_t> hashes;
    for (const int threads : {1, 2, 3, 4}) {
        REQUIRE(
            w.run("icesolve case.cfg -q --out r --overwrite --threads " + std::to_string(threads))
                .code == 0);
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
[flow]
model = "none"
[[floes]]
spheres = "floe.h5"
count = [30, 20]
gap = [0.0, 0.0]
hold = "never"
)");
    std::set<std::uint64_t> hashes;
    double contacts = 0.0;
    for (const int threads : {1, 2, 3}) {
        REQUIRE(w.run("icesolve field.cfg -q --allow-overlap --out r --overwrite --threads " +
                      std::to_string(threads))
                    .code == 0);
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
        "icesolve case.cfg --out r --set floes.hold=never --set floes.pattern=single "
        "--set floes.position=[5,0,-0.16] --set floes.velocity=[50,0,0] --set drag.model=none "
        "--set simulation.duration=999000 --set simulation.time_step=1 "
        "--set output.track=[] --set output.history_every=1000 --set output.frames_every=10000");
    CAPTURE(r.err);
    CHECK(r.code == 1);
    CHECK_THAT(r.err, Catch::Contains("step") && Catch::Contains("floe 1"));
    CHECK(read_summary(w / "r/summary.json").status == "failed");
    for (const std::string& name : w.files()) CHECK(name.find(".part") == std::string::npos);
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
    const Result r = w.run("icesolve case.cfg -q --json --out r");
    CHECK(r.err.empty());
    CHECK(r.out == slurp(w / "r/summary.json"));
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
    const auto refuses = w.refusing("icesolve ");
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
