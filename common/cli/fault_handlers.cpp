// SPDX-License-Identifier: GPL-3.0-or-later
// Handlers may run at any moment: they take no memory and no locks.
#include "common/cli/fault_handlers.hpp"

#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <exception>
#include <new>

#include "common/base/error.hpp"
#include "common/base/part_file.hpp"

namespace ice {

// One text for all programs, whole in advance: nothing can be formatted when memory is out.
const char* const kOutOfMemory =
    "out of memory\n  use a larger radius or spacing, a smaller case or fewer --threads, or give "
    "the program more memory (ulimit -v, the batch system's limit)";

namespace {

// A plain array: a signal handler may not allocate, and std::string may.
char program_name[64] = "";

void write_text(const char* text) {
    if (::write(STDERR_FILENO, text, std::strlen(text)) < 0) return;  // no reader is left
}

[[noreturn]] void end(const char* text, ExitCode code) {
    // write() and _exit() alone: this also runs in a signal handler, or when memory or the heap
    // itself is at its end, where printf, exit and destructors are not safe.
    write_text(program_name);
    write_text(": error: ");
    write_text(text);
    write_text("\n");
    remove_part_files();
    _exit(static_cast<int>(code));
}

[[noreturn]] void on_terminate() {
    try {
        // the exception in flight, if there is one: terminate is also called without
        if (std::current_exception()) std::rethrow_exception(std::current_exception());
    } catch (const std::bad_alloc&) {
        end(kOutOfMemory, ExitCode::failed);
    } catch (const Error& error) {
        end(error.what(), error.code());
    } catch (const std::exception& error) {
        write_text(error.what());
        write_text("\n");
    } catch (...) {
    }
    end("this is a fault of the program: please report it", ExitCode::failed);
}

void on_signal(int) { end("interrupted", ExitCode::interrupted); }

}  // namespace

void install_fault_handlers(const std::string& program) {
    const std::size_t length = std::min(program.size(), sizeof(program_name) - 1);
    program.copy(program_name, length);
    program_name[length] = '\0';
    // terminate is reached by exceptions that leave a thread or a destructor, which run_program
    // cannot catch.
    std::set_terminate(on_terminate);
    std::signal(SIGINT, on_signal);
    std::signal(SIGTERM, on_signal);
    // A file over the limit of ulimit -f, and a pipe without a reader, then are errors of the write
    // call, which names the file.
    std::signal(SIGXFSZ, SIG_IGN);
    std::signal(SIGPIPE, SIG_IGN);
}

}  // namespace ice
