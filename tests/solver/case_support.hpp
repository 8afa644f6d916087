// SPDX-License-Identifier: GPL-3.0-or-later
// A good case, and the complaint about a changed one.
#pragma once

#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "common/base/error.hpp"
#include "solver/case/read_case.hpp"

namespace ice::test {

inline const std::string kGood = R"(title = "test"
[simulation]
duration = 30.0
time_step = "5 ms"
[hull]
spheres = "hull.spheres.h5"
speed = "2 kn"
[[floes]]
spheres = "floe.spheres.h5"
count = [20, 9]
gap = ["20 mm", 0.02]
hold = "always"
[contact]
crushing_pressure = "1.5 MPa"
[output]
track = [1, 2]
)";

// A folder with a case file and the files it names.
class CaseFolder {
public:
    explicit CaseFolder(const std::string& text) {
        static int number = 0;
        folder_ =
            std::filesystem::temp_directory_path() /
            ("icesolve-case-test-" + std::to_string(::getpid()) + "-" + std::to_string(++number));
        std::filesystem::create_directories(folder_);
        std::ofstream(folder_ / "hull.spheres.h5") << "x";
        std::ofstream(folder_ / "floe.spheres.h5") << "x";
        std::ofstream(file()) << text;
    }
    ~CaseFolder() { std::filesystem::remove_all(folder_); }
    std::filesystem::path file() const { return folder_ / "case.cfg"; }

private:
    std::filesystem::path folder_;
};

inline std::string complaint(const std::string& text,
                             const std::vector<std::string>& overrides = {}) {
    const CaseFolder folder(text);
    try {
        read_case(folder.file(), overrides);
    } catch (const Error& error) {
        CHECK(error.code() == ExitCode::bad_input);
        return error.what();
    }
    return "";
}

inline std::string with(const std::string& from, const std::string& to) {
    std::string text = kGood;
    return text.replace(text.find(from), from.size(), to);
}

inline bool contains(const std::string& text, const std::string& part) {
    if (text.find(part) != std::string::npos) return true;
    UNSCOPED_INFO("not found: " << part << "\nin: " << text);
    return false;
}

}  // namespace ice::test
