// SPDX-License-Identifier: GPL-3.0-or-later
// Ensembles as a user meets them: icesolve CASE --seeds N.
//
// Tolerances: 1e-12 is rounding of a mean of three.
#include <signal.h>

#include <chrono>
#include <thread>

#include "common/formats/summary_file.hpp"
#include "tests/cli/workshop.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using namespace ice::test;

namespace {

constexpr const char* kThree = "icesolve case.cfg --seeds 3 --no-report --out e";

// Cells whose places the seed decides, before a block.
constexpr const char* kField = R"(pattern = "voronoi"
seed = 5
[ice]
thickness = 0.3
[area]
size = [4, 4]
origin = [0.1, 0]
[floes]
concentration = 0.7
mean_size = 0.9
[spheres]
radius = 0.1
)";

constexpr const char* kCase = R"([simulation]
duration = 1.5
time_step = 0.01
[hull]
spheres = "hull.h5"
position = [-1.2, 0, 0]
speed = 1.0
[[floes]]
pattern = "file"
file = "field.h5"
hold = "never"
[output]
average_from = 0.8
)";

// The command that a message prints, without the folder of the program.
std::string printed_command(const std::string& text, const std::string& holds) {
    const std::string program = ICE_BIN "/icesolve ";
    for (auto at = text.find(program); at != std::string::npos; at = text.find(program, at + 1)) {
        const std::string line = text.substr(at, text.find('\n', at) - at);
        if (line.find(holds) != std::string::npos) return "icesolve " + line.substr(program.size());
    }
    FAIL("no command with " << holds << " in: " << text);
    return {};
}

// An ensemble of members that would take hours, in the folder "e"; no signal but to itself.
class LongEnsemble {
public:
    explicit LongEnsemble(const Workshop& w) {
        const std::string folder = (w / "").string();
        child_ = fork();
        if (child_ == 0) {
            if (chdir(folder.c_str()) != 0) _exit(99);
            execl(ICE_BIN "/icesolve", "icesolve", "case.cfg", "-q", "--no-report", "--out", "e",
                  "--seeds", "2", "--set", "simulation.duration=5000", static_cast<char*>(nullptr));
            _exit(99);
        }
        REQUIRE(child_ > 0);
        for (int k = 0; k < 3000 && !fs::exists(w / "e/seed-1/run.h5.part"); ++k) pause();
        REQUIRE(fs::exists(w / "e/seed-1/run.h5.part"));
        const std::string id = std::to_string(child_);
        member_ = std::stoi(slurp("/proc/" + id + "/task/" + id + "/children"));
    }
    ~LongEnsemble() {
        kill(child_, SIGKILL);
        if (member_runs()) kill(member_, SIGKILL);
        wait();
    }

    static void pause() { std::this_thread::sleep_for(std::chrono::milliseconds(20)); }
    void send(int signal) const { kill(child_, signal); }
    void stop_member() const { kill(member_, SIGSTOP); }
    int wait() {
        int status = 0;
        if (!waited_) waitpid(child_, &status, 0);
        waited_ = true;
        return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    }
    bool member_runs() const {  // a dead one may wait for a parent that asks after it
        const std::string stat = slurp("/proc/" + std::to_string(member_) + "/stat");
        const auto name_end = stat.rfind(") ");
        return name_end != std::string::npos && stat[name_end + 2] != 'Z';
    }

private:
    pid_t child_ = -1, member_ = -1;
    bool waited_ = false;
};

}  // namespace

TEST_CASE("an ensemble's summary holds its members' means, and a second call keeps them", "[cli]") {
    const Workshop w;
    w.make_case();
    const Result r = w.run(kThree);
    CAPTURE(r.err);
    REQUIRE(r.code == 0);
    CHECK_THAT(r.err, Catch::Contains("ensemble of 3: resistance"));
    const Summary s = read_summary(w / "e/summary.json");
    REQUIRE(s.ensemble);
    CHECK(s.status == "completed");
    CHECK(s.ensemble->seeds == std::vector<std::int64_t>{1, 2, 3});
    double sum = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto member = w / ("e/seed-" + std::to_string(k + 1));
        const Summary one = read_summary(member / "summary.json");
        CHECK(one.resistance.mean == s.ensemble->means[k]);
        sum += one.resistance.mean;
    }
    CHECK(s.resistance.mean == Near(sum / 3.0).epsilon(1e-12));
    CHECK(s.ensemble->means[0] != s.ensemble->means[1]);
    // a hundredth of the spheres' radius, 0.1 m
    CHECK_THAT(slurp(w / "e/seed-2/case.resolved.cfg"),
               Catch::Contains("jitter = 0.001") && Catch::Contains("seed = 2"));
    CHECK(w.run("icepost table e e/seed-1").code == 0);

    // a member that is missing is computed, the others are kept; one more may be asked for
    fs::remove_all(w / "e/seed-2");
    const Result again = w.run("icesolve case.cfg --seeds 4 --no-report --out e");
    CAPTURE(again.err);
    REQUIRE(again.code == 0);
    CHECK_THAT(again.err, Catch::Contains("seed 1, member 1 of 4: finished before, kept") &&
                              Catch::Contains("seed 3, member 3 of 4: finished before, kept"));
    const Summary four = read_summary(w / "e/summary.json");
    CHECK(four.ensemble->means.size() == 4);
    CHECK(four.ensemble->means[1] == s.ensemble->means[1]);

    // another case may not mix with them
    const Result other = w.run(std::string(kThree) + " --set contact.friction_ship_ice=0.2");
    CHECK(other.code == 2);
    CHECK_THAT(other.err,
               Catch::Contains("holds a member of another case") && Catch::Contains("--overwrite"));
    CHECK(read_summary(w / "e/summary.json").ensemble->means.size() == 4);
    CHECK(w.run(std::string(kThree) + " --overwrite --set contact.friction_ship_ice=0.2").code ==
          0);
    CHECK(read_summary(w / "e/summary.json").ensemble->means != s.ensemble->means);
}

TEST_CASE("an ensemble refuses the folder of a single run with the commands that do it", "[cli]") {
    const Workshop w;
    w.make_case();
    REQUIRE(w.run("icesolve case.cfg -q --no-report --out e").code == 0);
    w.write("e/notes.txt", "mine");
    const std::string before = slurp(w / "e/summary.json");
    const Result r = w.run("icesolve case.cfg --seeds 2 --no-report --out e");
    CAPTURE(r.err);
    CHECK(r.code == 2);
    CHECK_THAT(r.err, Catch::Contains("e: holds a single run"));
    CHECK(slurp(w / "e/summary.json") == before);
    CHECK_FALSE(fs::exists(w / "e/seed-1"));
    CHECK(w.run(printed_command(r.err, "--out e-seeds")).code == 0);
    CHECK(read_summary(w / "e-seeds/summary.json").ensemble->means.size() == 2);

    // a case that cannot start removes nothing
    const std::string replace = printed_command(r.err, "--overwrite");
    CHECK(w.run(replace + " --set hull.position=[-4,0,0]").code == 2);
    CHECK(slurp(w / "e/summary.json") == before);
    // nothing of the old run is beside the ensemble
    REQUIRE(w.run(replace).code == 0);
    for (const char* old : {"run.h5", "forces.csv", "case.resolved.cfg", "floe_1.csv"})
        CHECK_FALSE(fs::exists(w / "e" / old));
    CHECK(slurp(w / "e/notes.txt") == "mine");
    CHECK(read_summary(w / "e/summary.json").ensemble->means.size() == 2);
}

TEST_CASE("an ensemble ends with the rules of its answer and with its warnings, each once",
          "[cli]") {
    const Workshop w;
    w.make_case();
    // the single run's warning of its course
    const std::string brief = "icesolve case.cfg --no-report --set output.average_from=2.9 --out ";
    const Result single = w.run(brief + "r");
    const std::vector<Warning> warned = read_summary(w / "r/summary.json").warnings;
    const auto course = std::find_if(warned.begin(), warned.end(), [](const Warning& x) {
        return x.text.find("length") != std::string::npos;
    });
    CAPTURE(single.err);
    REQUIRE(course != warned.end());
    for (int call = 0; call < 2; ++call) {  // also where all members are kept
        const Result r = w.run(brief + "e --seeds 2");
        CAPTURE(r.err);
        REQUIRE(r.code == 0);
        const std::string end = r.err.substr(r.err.find("ensemble of 2"));
        CHECK_THAT(end, Catch::Contains("floes held: "));
        const auto first = end.find(course->text);
        REQUIRE(first != std::string::npos);
        CHECK(end.find(course->text, first + 1) == std::string::npos);
    }
}

TEST_CASE("SIGTERM to an ensemble alone reaches its member, whose folder is locked till then",
          "[cli]") {
    const Workshop w;
    w.make_case();
    LongEnsemble ensemble(w);
    const std::string same =
        "icesolve case.cfg -q --no-report --out e --seeds 2 --set simulation.duration=5000";
    for (const char* option : {"", " --overwrite"}) {
        const Result r = w.run(same + option);
        CAPTURE(option, r.err);
        CHECK(r.code == 2);
        CHECK_THAT(r.err, Catch::Contains("e: another icesolve is writing this run"));
    }
    CHECK(fs::exists(w / "e/seed-1/run.h5.part"));
    ensemble.send(SIGTERM);
    CHECK(ensemble.wait() == 130);
    CHECK_FALSE(ensemble.member_runs());
    CHECK(fs::exists(w / "e/seed-1/checkpoint.h5"));
    CHECK(read_summary(w / "e/seed-1/summary.json").status == "interrupted");
}

TEST_CASE("a second SIGTERM ends an ensemble and leaves no member behind", "[cli]") {
    const Workshop w;
    w.make_case();
    LongEnsemble ensemble(w);
    ensemble.stop_member();  // one that does not end by itself
    ensemble.send(SIGTERM);
    std::this_thread::sleep_for(std::chrono::milliseconds(700));
    CHECK(ensemble.member_runs());
    ensemble.send(SIGTERM);
    CHECK(ensemble.wait() == 130);
    for (int k = 0; k < 500 && ensemble.member_runs(); ++k) LongEnsemble::pause();
    CHECK_FALSE(ensemble.member_runs());
}

TEST_CASE("all members are jittered where the seed changes no field, also the field's own seed",
          "[cli]") {
    const Workshop w;
    // the seed is a key of bricks, too, and changes nothing
    w.write("field.toml", R"(pattern = "brick"
seed = 1
[ice]
thickness = 0.3
[area]
origin = [0.1, 0]
[floes]
size = [1.0, 0.8]
count = [3, 3]
gap = [0.1, 0.1]
[spheres]
radius = 0.1
)");
    w.write("case.cfg", kCase);
    const Result made = w.run("icefield field.toml -q");
    CAPTURE(made.err);
    REQUIRE(made.code == 0);
    REQUIRE(w.run("spherize " ICE_MESHES "/paper-floe-3d.obj -r 0.1 -s 0.2 -o hull.h5 -q").code ==
            0);
    const Result r = w.run("icesolve case.cfg --seeds 2 --no-report --out e");
    CAPTURE(r.err);
    REQUIRE(r.code == 0);
    for (const char* member : {"e/seed-1", "e/seed-2"})
        CHECK_THAT(slurp(w / member / "case.resolved.cfg"), Catch::Contains("jitter = 0.001"));
    CHECK_FALSE(fs::exists(w / "e/fields/group-1-seed-1.h5"));
}

TEST_CASE("a member that fails ends the ensemble with its code and keeps the others", "[cli]") {
    const Workshop w;
    w.make_case();
    REQUIRE(w.run("icesolve case.cfg --seeds 1 -q --no-report --out e").code == 0);
    fs::create_directories(w / "e");
    w.write("e/seed-2", "in the way");
    const Result r = w.run(kThree);
    CAPTURE(r.err);
    CHECK(r.code == 1);
    const Summary s = read_summary(w / "e/summary.json");
    CHECK(s.ensemble->means.size() == 1);
    CHECK(s.status == "interrupted");
}

TEST_CASE("the seeds of a field from a specification make new fields", "[cli]") {
    const Workshop w;
    w.write("field.toml", kField);
    w.write("case.cfg", kCase);
    REQUIRE(w.run("icefield field.toml -q --set floes.mean_size=0.8").code == 0);
    REQUIRE(w.run("spherize " ICE_MESHES "/paper-floe-3d.obj -r 0.1 -s 0.2 -o hull.h5 -q").code ==
            0);
    const Result r = w.run("icesolve case.cfg --seeds 2 --no-report --out e");
    CAPTURE(r.err);
    REQUIRE(r.code == 0);
    const std::string first = slurp(w / "e/fields/group-1-seed-1.h5"),
                      second = slurp(w / "e/fields/group-1-seed-2.h5");
    CHECK_FALSE(first.empty());
    CHECK_FALSE(second.empty());
    CHECK(first != second);
    // the override that made the field makes its members, and no floe is jittered
    CHECK_THAT(first, Catch::Contains("# --set floes.mean_size=0.8"));
    CHECK_THAT(slurp(w / "e/seed-2/case.resolved.cfg"),
               Catch::Contains("group-1-seed-2.h5") && Catch::Contains("jitter = 0.0"));
    // the same command keeps both
    const Result again = w.run("icesolve case.cfg --seeds 2 --no-report --out e");
    CAPTURE(again.err);
    CHECK(again.code == 0);
    CHECK_THAT(again.err, Catch::Contains("member 2 of 2: finished before, kept"));
}

TEST_CASE("Ctrl-C in an ensemble keeps what is finished, and the command goes on", "[cli]") {
    const Workshop w;
    w.make_case();
    const std::string long_run = " --set simulation.duration=10 --threads 1";
    // what a terminal does: the signal goes to the whole group
    std::thread interrupt([&] {
        for (int k = 0; k < 600 && !fs::exists(w / "e/seed-2/run.h5.part"); ++k)
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        std::ifstream file(w / "group");
        int group = 0;
        if (file >> group) kill(-group, SIGINT);
    });
    w.write("go", "echo $$ > group\nexec " ICE_BIN "/" + std::string(kThree) + long_run +
                      " --overwrite\n");
    const std::string line =
        "cd '" + (w / "").string() + "' && setsid -w bash ./go >/dev/null 2>err.txt";
    const int status = std::system(line.c_str());
    interrupt.join();
    CAPTURE(slurp(w / "err.txt"));
    REQUIRE(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 130);
    const std::string go_on = printed_command(slurp(w / "err.txt"), "--seeds 3");
    CHECK_THAT(go_on, !Catch::Contains("--overwrite"));
    const Summary s = read_summary(w / "e/summary.json");
    CHECK(s.status == "interrupted");
    CHECK(s.ensemble->means.size() == 1);

    const Result r = w.run(go_on);
    CAPTURE(r.err);
    REQUIRE(r.code == 0);
    CHECK_THAT(r.err, Catch::Contains("seed 1, member 1 of 3: finished before, kept") &&
                          Catch::Contains("--restart"));
    CHECK(read_summary(w / "e/summary.json").ensemble->means.size() == 3);
}
