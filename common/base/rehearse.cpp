// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/base/rehearse.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <fstream>
#include <new>
#include <stdexcept>

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

// Exit codes of the child. Its pipe then has the bytes that were read (kSurvived), the Error's code
// and text (kRefused) or the text of another exception (kFault).
constexpr int kSurvived = 0, kOutOfMemory = 3, kRefused = 4, kFault = 5;

// A pipe's two ends, closed at the end of the scope.
class Pipe {
public:
    Pipe() : good_(pipe(ends_.data()) == 0) {}
    ~Pipe() {
        close_end(0);
        close_end(1);
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;

    bool good() const { return good_; }
    void close_end(std::size_t end) {
        if (good_ && ends_[end] >= 0) close(ends_[end]);
        ends_[end] = -1;
    }
    // The length first: the other side then takes memory once.
    void write(const std::string& text) const {
        const std::size_t size = text.size();
        if (put(&size, sizeof size)) put(text.data(), size);
    }
    // Empty where the other side closes its end before all of it.
    // @param most  [bytes]
    std::string read(std::uint64_t most) const {
        std::size_t size = 0;
        if (!get(&size, sizeof size) || size > most) return {};
        std::string all(size, '\0');
        if (!get(all.data(), size)) all.clear();
        return all;
    }

private:
    bool put(const void* from, std::size_t size) const {
        for (std::size_t done = 0; done < size;) {
            const ssize_t count =
                ::write(ends_[1], static_cast<const char*>(from) + done, size - done);
            if (count <= 0) return false;
            done += static_cast<std::size_t>(count);
        }
        return true;
    }
    bool get(void* to, std::size_t size) const {
        for (std::size_t filled = 0; filled < size;) {
            const ssize_t count = ::read(ends_[0], static_cast<char*>(to) + filled, size - filled);
            if (count < 0 && errno == EINTR) continue;
            if (count <= 0) return false;
            filled += static_cast<std::size_t>(count);
        }
        return true;
    }

    std::array<int, 2> ends_{-1, -1};
    bool good_;
};

void limit(int resource, rlim_t soft, rlim_t hard) {
    rlimit both{};
    getrlimit(static_cast<__rlimit_resource>(resource), &both);
    // Never above the limits in force: only root may raise a hard one.
    both.rlim_max = std::min(both.rlim_max, hard);
    both.rlim_cur = std::min(both.rlim_max, soft);
    setrlimit(static_cast<__rlimit_resource>(resource), &both);
}

#ifndef ICE_SANITIZED
// Addresses in use [bytes]; 0 where the system does not report them.
std::uint64_t address_space() {
    std::uint64_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    return pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}
#endif

void keep_within(const ReadBounds& bounds) {
    // the soft limit's signal (SIGXCPU) says that time was the reason; the hard one ends a process
    // that ignores it
    const auto seconds = static_cast<rlim_t>(std::ceil(bounds.seconds));
    limit(RLIMIT_CPU, seconds, seconds + 1);
    // A core file per damaged mesh would fill the disk of a batch job.
    limit(RLIMIT_CORE, 0, 0);
    limit(RLIMIT_FSIZE, 0, 0);
#ifndef ICE_SANITIZED
    // Beyond the memory in use: the child begins with a copy of all its parent's addresses.
    if (const std::uint64_t used = address_space(); used > 0)
        limit(RLIMIT_AS, used + bounds.bytes, used + bounds.bytes);
#endif
}

[[noreturn]] void do_in_child(const ReadBounds& bounds, const std::function<std::string()>& read,
                              const Pipe& messages) {
    // The parent's handlers print a message and remove its files; the child must end without
    // either.
    for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGXCPU, SIGINT, SIGTERM})
        std::signal(signal, SIG_DFL);
#if !defined(ICE_SANITIZED) || defined(ICE_FUZZ)
    // libraries print their own complaints, for which the user has no use
    if (const int nowhere = open("/dev/null", O_WRONLY); nowhere >= 0) dup2(nowhere, 2);
#endif
    keep_within(bounds);
    std::set_new_handler([] { _exit(kOutOfMemory); });  // libraries catch bad_alloc themselves
    try {
        messages.write(read());
    } catch (const Error& error) {
        messages.write(static_cast<char>(error.code()) + std::string(error.what()));
        _exit(kRefused);
    } catch (const std::bad_alloc&) {
        _exit(kOutOfMemory);
    } catch (const std::exception& fault) {
        messages.write(fault.what());
        _exit(kFault);
    }
    _exit(kSurvived);
}

std::string failure_text(int status, const ReadBounds& bounds) {
    // The way the child ended shows the cause: its own exit code, a limit's signal, another
    // one.
    std::string memory =
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

std::string read_in_child(const std::filesystem::path& file, const ReadBounds& bounds,
                          const std::function<std::string()>& read) {
    Pipe messages;
    // a process of its own: a library that crashes or never ends takes no program with it
    const pid_t child = messages.good() ? fork() : -1;
    if (child == 0) do_in_child(bounds, read, messages);
    if (child < 0)
        throw run_failed(
            file.string(),
            std::string("cannot be read: no process for it (") + std::strerror(errno) + ")",
            "end other programs, or raise the limits (ulimit -u, -n)");
    messages.close_end(1);
    // before waitpid: a child with more bytes than the pipe holds would wait for its reader
    std::string message = messages.read(bounds.bytes);
    // a child with more output than its bounds allow finds a closed pipe
    messages.close_end(0);
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    if (code == kSurvived) return message;
    if (code == kFault) throw std::runtime_error(message);
    // the Error of the child, thrown again as if it were the caller's
    if (code == kRefused && !message.empty())
        throw Error(static_cast<ExitCode>(message[0]), "", message.substr(1), "");
    throw bad_input(
        file.string(), failure_text(status, bounds),
        "the file is damaged or of another kind than its name says: make or export it again");
}

void rehearse(const std::filesystem::path& file, const ReadBounds& bounds,
              const std::function<void()>& read) {
    read_in_child(file, bounds, [&]() -> std::string {
        try {
            read();
        } catch (const Error&) {
            throw;
        } catch (const std::bad_alloc&) {
            throw;
        } catch (...) {  // a fault of ours: the caller meets it again, where a debugger finds it
        }
        return {};
    });
}

}  // namespace ice
