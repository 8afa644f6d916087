// SPDX-License-Identifier: GPL-3.0-or-later
// Run folders that exist: refused, replaced on request, never written by two programs.
#include <signal.h>
#include <sys/stat.h>

#include <chrono>
#include <thread>

#include "common/formats/summary_file.hpp"
#include "tests/cli/workshop.hpp"
#include "tests/support/compare_runs.hpp"

using namespace ice;
using namespace ice::test;

namespace {

using Files = std::vector<std::pair<std::string, std::string>>;

Files content(const Workshop& w, const std::string& folder) {
    Files files;
    for (const std::string& name : w.files())
        if (name.starts_with(folder + "/")) files.emplace_back(name, slurp(w / name));
    return files;
}

// A run that would take hours, in the folder "r"; killed at the end of the scope.
class LongRun {
public:
    explicit LongRun(const Workshop& w, const std::string& every = "1") {
        const std::string folder = (w / "").string();
        child_ = fork();
        if (child_ == 0) {
            if (chdir(folder.c_str()) != 0) _exit(99);
            execl(ICE_BIN "/icesolve", "icesolve", "case.cfg", "-q", "--out", "r", "--set",
                  "simulation.duration=5000", "--checkpoint-every", every.c_str(),
                  static_cast<char*>(nullptr));
            _exit(99);
        }
        REQUIRE(child_ > 0);
        for (int k = 0; k < 3000 && !fs::exists(w / "r/checkpoint.h5"); ++k)
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        REQUIRE(fs::exists(w / "r/checkpoint.h5"));
    }
    ~LongRun() { stop(SIGKILL); }

    int stop(int signal) {
        if (child_ <= 0) return 0;
        kill(child_, signal);
        int status = 0;
        waitpid(child_, &status, 0);
        child_ = -1;
        return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    }

private:
    pid_t child_ = -1;
};

}  // namespace

TEST_CASE(
    "without --out the run goes to the stem of the case file, or to its folder's name where "
    "the file is called case.cfg",
    "[cli]") {
    const Workshop w;
    w.make_case();
    fs::create_directories(w / "narrow");
    for (const char* name : {"hull.h5", "floe.h5", "case.cfg"})
        fs::copy(w / name, w / "narrow" / name);
    fs::copy(w / "case.cfg", w / "wide.cfg");
    const std::string brief = " -q --no-report --set simulation.duration=1.2";
    REQUIRE(w.run("icesolve narrow/case.cfg" + brief).code == 0);
    REQUIRE(w.run("icesolve wide.cfg" + brief).code == 0);
    CHECK(fs::exists(w / "results/narrow/summary.json"));
    CHECK(fs::exists(w / "results/wide/summary.json"));
    CHECK_FALSE(fs::exists(w / "results/case"));
}

TEST_CASE("a folder that holds a run is refused with the command that replaces it", "[cli]") {
    const Workshop w;
    w.make_case();
    REQUIRE(w.run("icesolve case.cfg -q --out 'my run'").code == 0);
    REQUIRE(fs::exists(w / "my run/floe_1.csv"));
    const Files before = content(w, "my run");
    const std::string again = "icesolve case.cfg -q --out 'my run' --set 'output.track=[]'";
    const Result refused = w.run(again);
    CAPTURE(refused.err);
    CHECK(refused.code == 2);
    CHECK_THAT(refused.err, Catch::Contains("my run: holds a run already"));
    CHECK(content(w, "my run") == before);

    // the printed command as it stands
    const auto line = refused.err.find(ICE_BIN "/icesolve case.cfg");
    REQUIRE(line != std::string::npos);
    const std::string command = refused.err.substr(line, refused.err.find('\n', line) - line);
    CHECK(command.ends_with(" --overwrite"));
    w.write("my run/notes.txt", "mine");
    w.write("my run/floe_plan.csv", "mine, too");
    w.write("my run/run.h5.part", "old");
    REQUIRE(w.run(command.substr(std::string(ICE_BIN "/").size())).code == 0);
    CHECK_FALSE(fs::exists(w / "my run/floe_1.csv"));
    CHECK_FALSE(fs::exists(w / "my run/run.h5.part"));
    CHECK(slurp(w / "my run/notes.txt") == "mine");
    CHECK(slurp(w / "my run/floe_plan.csv") == "mine, too");
}

TEST_CASE("an empty folder is used, one with foreign files is refused and left as it was",
          "[cli]") {
    const Workshop w;
    w.make_case();
    fs::create_directories(w / "empty");
    CHECK(w.run("icesolve case.cfg -q --no-report --out empty").code == 0);
    for (const char* name : {"letters.txt", "forces.csv", ".hidden"}) {
        const std::string folder = std::string("with-") + name;
        fs::create_directories(w / folder);
        w.write(folder + "/" + name, "mine");
        const Result r = w.run("icesolve case.cfg -q --no-report --out " + folder);
        CAPTURE(folder, r.err);
        CHECK(r.code == 2);
        CHECK_THAT(r.err, Catch::Contains(name) && Catch::Contains("--overwrite"));
        CHECK(content(w, folder) == Files{{folder + "/" + name, "mine"}});
    }
}

TEST_CASE("a case with a mistake and --overwrite removes nothing", "[cli][errors]") {
    const Workshop w;
    w.make_case();
    REQUIRE(w.run("icesolve case.cfg -q --no-report --out r --checkpoint-every 1").code == 0);
    const Files before = content(w, "r");
    for (const char* mistake :
         {"--set hull.sped=1", "--set output.track=[6]", "--set hull.position=[-4,0,0]",
          "--restart nowhere.h5", "--set ice.density=1100", "--check"}) {
        CAPTURE(mistake);
        w.run(std::string("icesolve case.cfg --out r --overwrite ") + mistake);
        CHECK(content(w, "r") == before);
    }
}

TEST_CASE(
    "a folder that a run writes is refused to a second run and to a restart, and free again "
    "when the first is killed",
    "[cli]") {
    const Workshop w;
    w.make_case();
    LongRun first(w);
    const std::string brief = " -q --no-report --set simulation.duration=1.2";
    const auto refuses = [&](const std::string& words) {
        const Result r = w.run("icesolve case.cfg" + brief + words);
        CAPTURE(words, r.err);
        CHECK(r.code == 2);
        CHECK_THAT(r.err, Catch::Contains("r: another icesolve is writing this run"));
    };
    refuses(" --out r");
    refuses(" --out r --overwrite");
    refuses(" --restart r/checkpoint.h5 --set simulation.duration=5000");
    CHECK(fs::exists(w / "r/run.h5.part"));
    CHECK(first.stop(SIGKILL) == -SIGKILL);
    const Result r = w.run("icesolve case.cfg --out r" + brief);
    CHECK(r.code == 2);
    CHECK_THAT(r.err, Catch::Contains("go on with that run with\n    " ICE_BIN
                                      "/icesolve case.cfg --set simulation.duration=1.2 "
                                      "--restart r/checkpoint.h5"));
    CHECK(w.run("icesolve case.cfg --out r --overwrite" + brief).code == 0);
    CHECK_FALSE(fs::exists(w / "r/checkpoint.h5"));
}

TEST_CASE("of runs begun at the same time into one folder one is computed, the others are refused",
          "[cli]") {
    const Workshop w;
    w.make_case();
    for (const char* options : {"", "--overwrite"}) {
        const std::string command = std::string(ICE_BIN
                                                "/icesolve case.cfg -q --no-report --threads 1 "
                                                "--set simulation.duration=1.5 --out r ") +
                                    options;
        // exit codes of three at once; --overwrite may also come after the first has ended
        w.run("icesolve --version >/dev/null; for k in 1 2 3; do (" + command +
              " 2>err$k; echo $? >code$k) & done; wait");
        int computed = 0;
        for (const char* k : {"1", "2", "3"}) {
            const int code = std::stoi(slurp(w / ("code" + std::string(k))));
            CAPTURE(options, k, slurp(w / ("err" + std::string(k))));
            CHECK((code == 0 || code == 2));
            computed += code == 0;
        }
        CHECK(computed >= 1);
        if (*options == '\0') CHECK(computed == 1);
        CHECK(read_summary(w / "r/summary.json").steps == 300);
        CHECK(fs::exists(w / "r/run.h5"));
        for (const std::string& name : w.files()) CHECK(name.find(".part") == std::string::npos);
    }
}

TEST_CASE(
    "a run that comes near the limit of a file stops in time, complete, and the printed command "
    "goes on to the same files",
    "[cli][checkpoint]") {
    const std::string checkpoints = GENERATE("", " --checkpoint-every 0.5");
    CAPTURE(checkpoints);
    const Workshop w;
    w.make_case();
    const std::string run = "icesolve case.cfg -q --no-report --set simulation.duration=30";
    REQUIRE(w.run(run + " --out whole").code == 0);
    const Result r = w.run("icesolve --version >/dev/null; (ulimit -f 3500; " ICE_BIN "/" + run +
                           checkpoints + " --out r)");
    CAPTURE(r.err);
    REQUIRE(r.code == 1);
    CHECK_THAT(r.err, Catch::Contains("r: the disk is almost full: the run stopped at t = "));
    const Summary stopped = read_summary(w / "r/summary.json");
    CHECK(stopped.status == "failed");
    CHECK(stopped.steps > 0);
    CHECK(stopped.steps < 6000);
    CHECK(w.run("icepost plot r -q -o r.svg").code == 0);
    for (const std::string& name : w.files()) CHECK(name.find(".part") == std::string::npos);

    const auto at = r.err.find(ICE_BIN "/icesolve case.cfg");
    REQUIRE(at != std::string::npos);
    const std::string command = r.err.substr(at, r.err.find('\n', at) - at);
    const Result rest = w.run(command.substr(std::string(ICE_BIN "/").size()) + " -q --no-report");
    CAPTURE(rest.err);
    REQUIRE(rest.code == 0);
    check_same_runs(w / "whole", w / "r", {1});
}

TEST_CASE("a run that has ended holds no more of the disk than its files are long", "[cli]") {
    const Workshop w;
    w.make_case();
    REQUIRE(w.run("icesolve case.cfg -q --no-report --out r").code == 0);
    struct stat state {};
    REQUIRE(stat((w / "r/run.h5").c_str(), &state) == 0);
    CHECK(512 * state.st_blocks <= state.st_size + (1 << 17));  // blocks of up to 128 kB
}

TEST_CASE("a run that is on its way can be looked at, at any time", "[cli]") {
    const Workshop w;
    w.make_case();
    LongRun run(w);
    for (int k = 0; k < 400 && fs::file_size(w / "r/forces.csv.part") < 100000; ++k)
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    for (int k = 0; k < 15; ++k) {
        const Result r = w.run("icepost plot r -q -o r.svg");
        CAPTURE(k, r.err);
        CHECK(r.code == 0);
    }
}
