// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cli/sibling_program.hpp"

#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>

#include "common/cli/console.hpp"

namespace ice {

std::optional<int> run_child(const std::string& program, const std::vector<std::string>& words) {
    // posix_spawn, not system(): no shell takes the words apart.
    std::vector<std::string> texts{program};
    texts.insert(texts.end(), words.begin(), words.end());
    std::vector<char*> argv;
    for (std::string& text : texts) argv.push_back(text.data());
    argv.push_back(nullptr);
    pid_t child = 0;
    const bool before = interrupted();
    if (posix_spawnp(&child, program.c_str(), nullptr, nullptr, argv.data(), environ) != 0)
        return std::nullopt;
    pass_interrupts_to(child);
    if (interrupted() && !before) kill(child, SIGTERM);  // came while the program was started
    // its number is not given away before nothing is passed on to it any longer
    siginfo_t ended{};
    while (waitid(P_PID, child, &ended, WEXITED | WNOWAIT) < 0 && errno == EINTR) continue;
    pass_interrupts_to(0);
    int status = 0;
    while (waitpid(child, &status, 0) < 0)
        if (errno != EINTR) return std::nullopt;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

namespace {

// Empty where the system does not name this program's own file.
std::string path_of_sibling(const std::string& name) {
    std::error_code error;
    const auto own = std::filesystem::read_symlink("/proc/self/exe", error);
    return error ? "" : (own.parent_path() / name).string();
}

}  // namespace

bool has_sibling(const std::string& name) {
    const std::string program = path_of_sibling(name);
    return !program.empty() && access(program.c_str(), X_OK) == 0;
}

std::optional<int> run_sibling(const std::string& name, const std::vector<std::string>& words) {
    if (!has_sibling(name)) return std::nullopt;
    return run_child(path_of_sibling(name), words);
}

}  // namespace ice
