// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/fuzz/input_folder.hpp"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>

namespace ice::fuzz {

namespace fs = std::filesystem;

InputFolder::InputFolder() : owner_(::getpid()) {
    const fs::path memory = "/dev/shm";
    const fs::path parent = fs::is_directory(memory) ? memory : fs::temp_directory_path();
    path_ = parent / ("ice-fuzz-" + std::to_string(owner_));
    fs::create_directories(path_);
}

InputFolder::~InputFolder() {
    if (::getpid() != owner_) return;  // a child that a library made exit
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

fs::path InputFolder::write(const std::string& name, std::string_view bytes) const {
    fs::path file = path_ / name;
    std::ofstream out(file, std::ios::binary);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return file;
}

void report_finding(std::string_view what) {
    std::fprintf(stderr, "finding: %.*s\n", static_cast<int>(what.size()), what.data());
    std::abort();
}

}  // namespace ice::fuzz
