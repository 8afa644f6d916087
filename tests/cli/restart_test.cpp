// SPDX-License-Identifier: GPL-3.0-or-later
// Runs that are killed from outside and continued: the files are those of a run left alone.
#include <signal.h>

#include <chrono>
#include <random>
#include <thread>

#include "common/formats/checkpoint_file.hpp"
#include "tests/cli/workshop.hpp"
#include "tests/support/compare_runs.hpp"

using namespace ice;
using namespace ice::test;

namespace {

// A run that would take hours, in the folder "r", ended by a signal some time after the file `sign`
// is there.
int kill_run(const Workshop& w, const std::vector<std::string>& more, int signal,
             const std::string& sign, int delay_ms) {
    const std::string folder = (w / "").string();
    std::vector<std::string> words{"icesolve", "case.cfg", "--out",
                                   "r",        "--set",    "simulation.duration=5000"};
    words.insert(words.end(), more.begin(), more.end());
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const pid_t child = fork();
    if (child == 0) {
        if (chdir(folder.c_str()) != 0 || freopen("child.txt", "w", stderr) == nullptr) _exit(99);
        execv(ICE_BIN "/icesolve", arguments.data());
        _exit(99);
    }
    REQUIRE(child > 0);
    for (int k = 0; k < 2000 && !fs::exists(w / sign); ++k)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    std::this_thread::sleep_for(std::chrono::milliseconds(delay_ms));
    kill(child, signal);
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

double time_of(const fs::path& checkpoint) {
    CheckpointFile file(checkpoint, CheckpointFile::Direction::read);
    double time = 0.0;
    file.carry("time", time);
    return time;
}

// Continues "r" for another second and compares it with a run of that length left alone.
void check_continued(const Workshop& w) {
    const std::string duration =
        " --set simulation.duration=" + std::to_string(1.0 + time_of(w / "r/checkpoint.h5"));
    const Result whole = w.run("icesolve case.cfg -q --threads 1 --out whole" + duration);
    CAPTURE(whole.err);
    REQUIRE(whole.code == 0);
    const Result rest =
        w.run("icesolve case.cfg -q --threads 3 --restart r/checkpoint.h5" + duration);
    CAPTURE(rest.err);
    REQUIRE(rest.code == 0);
    check_same_runs(w / "whole", w / "r", {1});
    for (const std::string& name : w.files()) CHECK(name.find(".part") == std::string::npos);
}

int random_delay() { return static_cast<int>(std::random_device()() % 300); }

}  // namespace

TEST_CASE("a run ended by SIGTERM or Ctrl-C at any time goes on to the same files",
          "[cli][checkpoint]") {
    const int signal = GENERATE(SIGTERM, SIGINT);
    const int delay = random_delay();
    CAPTURE(signal, delay);
    const Workshop w;
    w.make_case("history_every = 0.013\n");
    CHECK(kill_run(w, {}, signal, "r/forces.csv.part", delay) == 130);
    CHECK(read_summary(w / "r/summary.json").status == "interrupted");
    CHECK_THAT(slurp(w / "child.txt"),
               Catch::Contains("icesolve case.cfg --set simulation.duration=5000 --restart "
                               "r/checkpoint.h5"));
    check_continued(w);
}

TEST_CASE("a run killed by SIGKILL, even while it writes, goes on to the same files",
          "[cli][checkpoint]") {
    // a checkpoint every step: the kill most likely falls into one
    const std::string every = GENERATE("0.005", "0.005", "0.005", "0.1");
    const int delay = random_delay();
    CAPTURE(every, delay);
    const Workshop w;
    w.make_case();
    CHECK(kill_run(w, {"-q", "--checkpoint-every", every}, SIGKILL, "r/checkpoint.h5", delay) ==
          -SIGKILL);
    CHECK_FALSE(fs::exists(w / "r/summary.json"));
    check_continued(w);
}

// The last time of a CSV file that a kill may have torn: the last whole row's.
static double last_time_of(const fs::path& rows) {
    const std::string text = slurp(rows);
    const std::size_t end = text.rfind('\n');
    return std::stod(text.substr(text.rfind('\n', end - 1) + 1));
}

TEST_CASE("without --checkpoint-every a kill loses the work since the last autosave at most",
          "[cli][checkpoint]") {
    const int delay = random_delay();
    CAPTURE(delay);
    const Workshop w;
    w.make_case();
    // an interval that every step outlasts: nothing but the step that the kill ends may be lost
    CHECK(kill_run(w, {"-q", "--autosave", "1e-6"}, SIGKILL, "r/checkpoint.h5", delay) == -SIGKILL);
    const double step = 0.005;
    CHECK(time_of(w / "r/checkpoint.h5") >= last_time_of(w / "r/forces.csv.part") - 1.5 * step);
    check_continued(w);

    // nobody asked to keep it: a run that ends removes it; by default a short run writes none
    CHECK(w.run("icesolve case.cfg -q --out ended --autosave 1e-6").code == 0);
    CHECK_FALSE(fs::exists(w / "ended/checkpoint.h5"));
    fs::remove_all(w / "r");
    CHECK(kill_run(w, {"-q"}, SIGKILL, "r/forces.csv.part", delay) == -SIGKILL);
    CHECK_FALSE(fs::exists(w / "r/checkpoint.h5"));
    CHECK(w.run("icesolve case.cfg --out t --autosave 1 --checkpoint-every 1").code == 2);
}

TEST_CASE("after a restart --hash-every prints the lines that the whole run prints",
          "[cli][checkpoint]") {
    const Workshop w;
    w.make_case();
    const std::string whole = w.run("icesolve case.cfg -q --out a --hash-every 50").out;
    const std::string first =
        w.run(
             "icesolve case.cfg -q --out b --hash-every 50 --checkpoint-every 9 --set "
             "simulation.duration=1.3")
            .out;
    const std::string rest =
        w.run("icesolve case.cfg -q --hash-every 50 --restart b/checkpoint.h5").out;
    CHECK(std::count(rest.begin(), rest.end(), '\n') == 7);
    CHECK(first + rest == whole);
}

TEST_CASE("a restart that would shorten a run is refused without --overwrite",
          "[cli][checkpoint][errors]") {
    const Workshop w;
    w.make_case();
    const std::string run = "icesolve case.cfg -q --no-report ";
    REQUIRE(w.run(run + "--out r --checkpoint-every 9 --set simulation.duration=1.3").code == 0);
    fs::copy_file(w / "r/checkpoint.h5", w / "r/old.h5");
    REQUIRE(w.run(run + "--restart r/checkpoint.h5 --checkpoint-every 9").code == 0);
    const std::string forces = slurp(w / "r/forces.csv");
    const std::string shorter = "--restart r/old.h5 --set simulation.duration=1.4";
    const Result refused = w.run(run + shorter);
    CHECK(refused.code == 2);
    CHECK_THAT(refused.err, Catch::Contains("and this one ends at 1.4 s") &&
                                Catch::Contains("add --overwrite to shorten it"));
    CHECK(slurp(w / "r/forces.csv") == forces);
    CHECK(w.run(run + "--restart r/old.h5").code == 0);  // the same rows again
    CHECK(slurp(w / "r/forces.csv") == forces);
    CHECK(w.run(run + shorter + " --overwrite").code == 0);
    CHECK(slurp(w / "r/forces.csv") != forces);
}

TEST_CASE("a bad checkpoint ends with exit code 2 and changes nothing", "[cli][errors]") {
    const Workshop w;
    w.make_case();
    REQUIRE(w.run("icesolve case.cfg -q --out r --checkpoint-every 1").code == 0);
    const std::string forces = slurp(w / "r/forces.csv"), good = slurp(w / "r/checkpoint.h5");
    const auto refuses = [&](const std::string& arguments, const std::string& words) {
        const Result r = w.run("icesolve case.cfg " + arguments);
        CAPTURE(arguments, r.err);
        CHECK(r.code == 2);
        CHECK_THAT(r.err, Catch::Contains(words));
        CHECK(slurp(w / "r/forces.csv") == forces);
        CHECK(fs::exists(w / "r/summary.json"));
    };
    refuses("--restart nowhere.h5", "nowhere.h5: checkpoint not found");
    refuses("--restart r", "not found");
    refuses("--restart hull.h5", "not a checkpoint");
    refuses("--restart r/checkpoint.h5 --set ice.density=917",
            "ice.density: 900.0 in the checkpoint, 917.0 in the case");
    refuses("--restart r/checkpoint.h5 --set simulation.duration=2", "before the checkpoint");
    refuses("--checkpoint-every 0", "checkpoint-every");
    REQUIRE(
        w.run("spherize " ICE_MESHES "/paper-floe-2d.obj --slice y=0 -r 0.05 -o floe.h5 -q").code ==
        0);
    refuses("--restart r/checkpoint.h5", "floes.1.spheres");
    w.write("r/checkpoint.h5", good.substr(0, good.size() / 2));
    refuses("--restart r/checkpoint.h5", "damaged");
}
