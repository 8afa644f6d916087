// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/base/rehearse.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <fstream>
#include <new>

#include "common/base/error.hpp"

// Sanitizers reserve terabytes of addresses, which no bound on them can be set against.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define ICE_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define ICE_SANITIZED 1
#endif
#endif

namespace ice {

namespace {

constexpr int kSurvived = 0, kOutOfMemory = 3;  // exit codes of the child

void limit(int resource, rlim_t soft, rlim_t hard) {
    rlimit both{};
    getrlimit(static_cast<__rlimit_resource>(resource), &both);
    both.rlim_max = std::min(both.rlim_max, hard);
    both.rlim_cur = std::min(both.rlim_max, soft);
    setrlimit(static_cast<__rlimit_resource>(resource), &both);
}

#ifndef ICE_SANITIZED
// Addresses in use [bytes]; 0 where the system does not say.
std::uint64_t address_space() {
    std::uint64_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    return pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}
#endif

void keep_within(const ReadBounds& bounds) {
    const auto seconds = static_cast<rlim_t>(std::ceil(bounds.seconds));
    limit(RLIMIT_CPU, seconds, seconds + 1);
    limit(RLIMIT_CORE, 0, 0);
    limit(RLIMIT_FSIZE, 0, 0);
#ifndef ICE_SANITIZED
    if (const std::uint64_t used = address_space(); used > 0)
        limit(RLIMIT_AS, used + bounds.bytes, used + bounds.bytes);
#endif
}

[[noreturn]] void do_in_child(const ReadBounds& bounds, const std::function<void()>& read) {
    for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGXCPU, SIGINT, SIGTERM})
        std::signal(signal, SIG_DFL);
#if !defined(ICE_SANITIZED) || defined(ICE_FUZZ)
    if (const int nowhere = open("/dev/null", O_WRONLY); nowhere >= 0) dup2(nowhere, 2);
#endif
    keep_within(bounds);
    try {
        read();
    } catch (const std::bad_alloc&) {
        _exit(kOutOfMemory);
    } catch (...) {  // the caller meets it again
    }
    _exit(kSurvived);
}

std::string what_happened(int status, const ReadBounds& bounds) {
    const std::string memory =
        fmt::format("takes more than {:.0f} MB of memory to read", 1e-6 * double(bounds.bytes));
    if (WIFEXITED(status) && WEXITSTATUS(status) == kOutOfMemory) return memory;
    if (!WIFSIGNALED(status)) return "makes the library that reads it give up";
    const int signal = WTERMSIG(status);
    if (signal == SIGXCPU || signal == SIGKILL)
        return fmt::format("takes more than {:.0f} s of processor time to read", bounds.seconds);
    return fmt::format("crashes the library that reads it (signal {})", signal);
}

}  // namespace

ReadBounds ReadBounds::for_size(std::uint64_t size) {
    ReadBounds bounds;
#ifdef ICE_FUZZ
    bounds.seconds = 1.0;  // a fuzzer meets too many endless files to wait longer
#endif
    bounds.seconds += 5e-6 * static_cast<double>(size);
    bounds.bytes += 64 * size;
    return bounds;
}

void rehearse(const std::filesystem::path& file, const ReadBounds& bounds,
              const std::function<void()>& read) {
    const pid_t child = fork();
    if (child == 0) do_in_child(bounds, read);
    if (child < 0)
        throw run_failed(
            file.string(),
            std::string("cannot be read: no process for it (") + std::strerror(errno) + ")",
            "end other programs, or raise the limit (ulimit -u)");
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (WIFEXITED(status) && WEXITSTATUS(status) == kSurvived) return;
    throw bad_input(file.string(), what_happened(status, bounds),
                    "the file is damaged or not what its name says: make or export it again");
}

}  // namespace ice
