// SPDX-License-Identifier: GPL-3.0-or-later
// Threads that sleep while they wait for work.
//
// By default GCC's OpenMP lets a thread that waits spin for some hundred thousand turns before it
// sleeps. A step of the solver has a dozen short parallel loops. Where the cores are not free (a
// second run, another user) the thread that has work is then kept from its core by spinning ones,
// and a run took 3 to 6 times as long as with one thread. A sleeping thread takes no core; waking
// it costs some microseconds a loop (tests/bench/README.md, threads.py).
//
// OpenMP has no function for this: the library reads its environment when it is loaded, before
// main(). The program therefore sets the variable and starts itself again, once. A value that the
// user has set wins, and programs that use the project as a library set it themselves
// (docs/library.md).
#include "common/cli/start_threads.hpp"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <latch>
#include <string>
#include <thread>
#include <vector>

#include "common/base/parallel.hpp"

namespace ice {

namespace {

// Returns where it cannot be done: the program is right without it, only slower.
void begin_anew_with_sleeping_threads() {
    if (std::getenv("OMP_WAIT_POLICY") != nullptr || std::getenv("GOMP_SPINCOUNT") != nullptr)
        return;
    std::error_code error;
    const auto own = std::filesystem::read_symlink("/proc/self/exe", error);
    std::ifstream in("/proc/self/cmdline", std::ios::binary);
    std::string words{std::istreambuf_iterator<char>(in), {}};
    if (error || words.empty()) return;
    std::vector<char*> argv;  // each word ends with a zero
    for (std::size_t k = 0; k < words.size(); k = words.find('\0', k) + 1)
        argv.push_back(words.data() + k);
    argv.push_back(nullptr);
    std::fflush(nullptr);
    ::setenv("OMP_WAIT_POLICY", "passive", 1);
    ::execv(own.c_str(), argv.data());
}

}  // namespace

void start_threads() {
    const int others = thread_count() - 1;
    if (others > 0) begin_anew_with_sleeping_threads();
    // A trial with plain threads, whose failure is an exception: OpenMP would end the program
    // instead.
    std::vector<std::thread> trial;
    const auto join = [&] {
        for (std::thread& thread : trial) thread.join();
    };
    std::latch all_there(1);  // they must live at the same time
    try {
        for (int k = 0; k < others; ++k) trial.emplace_back([&] { all_there.wait(); });
    } catch (...) {
        all_there.count_down();
        join();
        throw;
    }
    all_there.count_down();
    join();
    parallel_tasks(static_cast<std::size_t>(thread_count()), true, [](std::size_t) {});
}

}  // namespace ice
