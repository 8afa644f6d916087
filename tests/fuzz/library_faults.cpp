// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/fuzz/library_faults.hpp"

#include <sanitizer/asan_interface.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <string_view>

#include "tests/fuzz/input_folder.hpp"
#include "tests/fuzz/library_faults.hpp"

namespace {

// Shared with the children: the report of a fault in our own code, or nothing.
struct Report {
    char text[1 << 16];
};

Report& shared() {
    static Report* const page = static_cast<Report*>(
        mmap(nullptr, sizeof(Report), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
    return *page;
}

bool in_library(std::string_view report) {
    report.remove_prefix(std::min(report.find("ERROR: AddressSanitizer"), report.size()));
    const std::string_view stack = report.substr(0, report.find("\n\n"));
    return stack.find("/libassimp.so") != stack.npos || stack.find("/libhdf5") != stack.npos ||
           stack.find("/libz.so") != stack.npos;
}

pid_t main_process = 0;

void keep(std::string_view text) {
    std::memcpy(shared().text, text.data(), std::min(text.size(), sizeof(Report) - 1));
}

void look_at(const char* report) {
    if (getpid() == main_process) return;  // the fuzzer's own business
    if (!in_library(report)) keep(report);
    _exit(1);
}

}  // namespace

// Undefined behaviour is watched for in our own code only.
extern "C" void __ubsan_on_report() {
    if (getpid() == main_process) return;
    keep(
        "undefined behaviour in a child process: run the input with handle_segv=0 under a "
        "debugger");
}

extern "C" int LLVMFuzzerInitialize(int*, char***) {
    main_process = getpid();
    shared();
    __asan_set_error_report_callback(look_at);
    return 0;
}

// Little memory is kept back after it was freed: it makes the children slow to start.
extern "C" const char* __asan_default_options() { return "quarantine_size_mb=4"; }

// What the libraries leak on their way out of a damaged file is theirs.
extern "C" const char* __lsan_default_suppressions() { return "leak:libhdf5\nleak:libassimp\n"; }

namespace ice::fuzz {

void check_child_faults() {
    if (shared().text[0] != '\0') report_finding(shared().text);
}

int verdict(const Error& refusal) {
    return std::string_view(refusal.what()).find("processor time") == std::string_view::npos ? 0
                                                                                             : -1;
}

}  // namespace ice::fuzz
