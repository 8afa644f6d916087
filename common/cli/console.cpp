// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cli/console.hpp"

#include <signal.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <sys/ioctl.h>
#include <time.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <stdexcept>
#include <system_error>

#include "common/base/error.hpp"
#include "common/cli/fault_handlers.hpp"

namespace ice {

namespace {

// State of the process that its signal handlers read or write, and of its terminal.
struct ConsoleState {
    volatile std::sig_atomic_t interrupted = 0;
    std::atomic<std::int64_t> interrupted_at = 0;  // [ns]
    std::atomic<int> waited_for = 0;               // the program that interrupts are passed on to
    bool reader_gone = false;                      // of stdout
    const char* program = "";                      // as the user typed it
    static_assert(std::atomic<int>::is_always_lock_free);  // as a signal handler needs it
    static_assert(std::atomic<std::int64_t>::is_always_lock_free);
};

// One for the process, since a signal handler gets nothing but the signal's number. It is made
// before the program runs (constinit): a handler may not wait for that.
ConsoleState& console() {
    static constinit ConsoleState state;
    return state;
}

// After a failure there, which a full disk shows as late as when the last data are written.
void check_stdout() {
    if (errno == EPIPE) {
        console().reader_gone = true;
        return;
    }
    throw run_failed("standard output", std::string("cannot be written: ") + std::strerror(errno),
                     "check that the disk is not full");
}

// A terminal and `timeout` signal a whole group of programs, and one of them may pass the signal on
// to another: a second signal within this time is the same interrupt. Longer delays the end by a
// second Ctrl-C, shorter takes an echo for one. Half a second [ns].
constexpr std::int64_t kOneInterrupt = 500'000'000;

void on_interrupt(int signal) {
    // A handler interrupts code between a failed call and the test of errno.
    const int before = errno;
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    const std::int64_t time = now.tv_sec * std::int64_t{1'000'000'000} + now.tv_nsec;
    ConsoleState& state = console();
    const pid_t child = state.waited_for;
    // The first interrupt ends the program with all files closed; a second one, which is not an
    // echo of the first, does not wait for it.
    if (state.interrupted == 0) {
        state.interrupted_at = time;
        state.interrupted = 1;
        if (child > 0) kill(child, signal);
    } else if (time - state.interrupted_at > kOneInterrupt) {
        if (child > 0) kill(child, SIGKILL);
        _exit(static_cast<int>(ExitCode::interrupted));
    }
    errno = before;
}

}  // namespace

bool stderr_is_terminal() {
    // A redrawn line is a mess in a log: every sign of a log counts.
    const char* kind = std::getenv("TERM");
    return isatty(STDERR_FILENO) == 1 && std::getenv("CI") == nullptr && kind != nullptr &&
           std::strcmp(kind, "dumb") != 0;
}

int terminal_width() {
    // The terminal's own word comes first: COLUMNS keeps its old value when a window is resized.
    winsize size{};
    if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
    const char* columns = std::getenv("COLUMNS");
    const int width = columns != nullptr ? std::atoi(columns) : 0;
    return width > 0 ? width : 80;
}

void start_messages(Colour colour, bool quiet) {
    const bool colourful =
        colour == Colour::always ||
        (colour == Colour::automatic && stderr_is_terminal() && std::getenv("NO_COLOR") == nullptr);
    auto sink = std::make_shared<spdlog::sinks::stderr_color_sink_mt>(
        colourful ? spdlog::color_mode::always : spdlog::color_mode::never);
    // The level is the sink's, not the logger's: a log file has all messages also with --quiet.
    sink->set_level(quiet ? spdlog::level::err : spdlog::level::info);
    auto logger = std::make_shared<spdlog::logger>("ice", sink);
    logger->set_pattern("%^%v%$");
    spdlog::set_default_logger(logger);
}

void log_to_file(const std::filesystem::path& path, bool append) {
    try {
        auto sink = std::make_shared<spdlog::sinks::basic_file_sink_mt>(path.string(), !append);
        sink->set_pattern("%Y-%m-%d %H:%M:%S  %v");
        spdlog::default_logger()->sinks().push_back(sink);
        // Each line at once: a log is read during the run, and after it was killed.
        spdlog::default_logger()->flush_on(spdlog::level::info);
    } catch (const spdlog::spdlog_ex&) {
        throw run_failed(path.string(), "cannot be written",
                         "check that the folder is writable and the disk is not full");
    }
}

void say(const std::string& text) { spdlog::info("{}", text); }

void say_warning(const std::string& text) { spdlog::warn("warning: {}", text); }

void write_data(const std::string& text) {
    if (console().reader_gone || std::fwrite(text.data(), 1, text.size(), stdout) == text.size())
        return;
    check_stdout();
}

int run_program(const std::string& name, const std::function<int()>& body,
                const std::string& to_save_memory) {
    install_fault_handlers(name);
    const auto complain = [&](const std::string& text) {
        spdlog::error("{}: error: {}", name, text);
    };
    // given back when memory runs out, so that there is some for the message
    auto reserve = std::make_unique<std::array<char, 1 << 18>>();
    const auto out_of_memory = [&] {
        reserve.reset();
        try {
            complain("out of memory\n  " + to_save_memory + ", or a machine with more memory");
        } catch (const std::exception&) {  // not even enough for these words
            std::fputs("error: out of memory\n", stderr);
        }
    };
    try {
        // Buffered data fail as late as here: without this flush a full disk would be no error at
        // all.
        const int code = body();
        if (!console().reader_gone && (std::fflush(stdout) != 0 || std::ferror(stdout) != 0))
            check_stdout();
        return code;
    } catch (const Error& error) {
        complain(error.what());
        return static_cast<int>(error.code());
    } catch (const std::bad_alloc&) {
        out_of_memory();
        // From here on in the order of their remedies: less memory, another path, a fault of the
        // program. bad_alloc is not Error, and filesystem_error is a system_error, so it must come
        // first.
    } catch (const std::length_error&) {  // more elements than any memory could hold
        out_of_memory();
    } catch (const std::filesystem::filesystem_error& error) {
        complain(error.path1().string() + ": " + error.code().message() +
                 "\n  check the path and its permissions");
    } catch (const std::ios_base::failure& error) {
        complain(std::string("an input cannot be read: ") + error.what() +
                 "\n  check that it is a file");
    } catch (const std::system_error& error) {
        if (error.code() == std::errc::resource_unavailable_try_again)  // a thread cannot start
            out_of_memory();
        else  // of fmt::print
            complain(std::string("standard output: ") + error.what() +
                     "\n  check that the disk is not full");
    } catch (const std::exception& error) {
        complain(std::string(error.what()) +
                 "\n  this is a fault of the program: please report it");
    }
    return static_cast<int>(ExitCode::failed);
}

void catch_interrupts() {
    std::signal(SIGINT, on_interrupt);
    std::signal(SIGTERM, on_interrupt);
}

bool interrupted() { return console().interrupted != 0; }

void pass_interrupts_to(int program) { console().waited_for = program; }

std::string typed_program() { return shell_word(console().program); }
void set_typed_program(const char* word) { console().program = word; }

std::string shell_word(const std::string& word) {
    // Single quotes keep everything but a single quote, which leaves them, is escaped and begins
    // anew.
    const bool plain = word.find_first_of(" '\"$*?[]{}()<>|&;\\") == std::string::npos;
    if (plain && !word.empty()) return word;
    std::string quoted = "'";
    for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

std::string command_line(int argc, const char* const* argv) {
    std::string line;
    for (int k = 0; k < argc; ++k) {
        if (k > 0) line += ' ';
        line += shell_word(k == 0 ? std::filesystem::path(argv[0]).filename().string() : argv[k]);
    }
    return line;
}

}  // namespace ice
