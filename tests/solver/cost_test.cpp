// SPDX-License-Identifier: GPL-3.0-or-later
// What --check says of a run's size, and the limit of open files.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include "solver/run/describe_cost.hpp"
#include "tests/common/fixtures.hpp"

using namespace ice;

TEST_CASE("a run's rows, frames and bytes are those of its keys", "[cost][analytic]") {
    Case p;
    p.duration = 1000.0;
    p.time_step = 0.01;
    p.history_every = 0.1;
    p.frames_every = 2.0;
    p.track = {1, 2, 3};
    const RunCost cost = run_cost(p, 200, 2);
    CHECK(cost.steps == 100'000);
    CHECK(cost.rows == 10'000);
    CHECK(cost.frames == 501);
    // 25 numbers of the ship, 22 of each tracked floe, 6 floats of each region; 65 bytes a floe
    CHECK(cost.run_file == 10'000.0 * (25 * 8 + 3 * 22 * 8 + 2 * 6 * 4) + 501.0 * 65 * 200);
    CHECK(cost.tables == 10'000.0 * 12 * (11 + 3 * 23));
    CHECK(cost.memory == 64e5);
}

TEST_CASE("more tracked floes than files may be open are refused before the run", "[cost]") {
    Case p;
    for (int k = 1; k <= 200; ++k) p.track.push_back(k);
    const auto code_with = [&](rlim_t soft, rlim_t hard) {
        const pid_t child = fork();
        if (child == 0) {
            const rlimit limit{soft, hard};
            if (setrlimit(RLIMIT_NOFILE, &limit) != 0) _exit(9);
            const std::string text = test::error_text([&] { require_open_files(p); });
            _exit(text.empty() ? 0 : text.find("ulimit -n 232") != std::string::npos ? 2 : 8);
        }
        int status = 0;
        waitpid(child, &status, 0);
        return WEXITSTATUS(status);
    };
    CHECK(code_with(100, 231) == 2);
    CHECK(code_with(100, 232) == 0);  // the soft limit is raised
    CHECK(code_with(232, 232) == 0);
}
