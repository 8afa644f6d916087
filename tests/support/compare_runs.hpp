// SPDX-License-Identifier: GPL-3.0-or-later
/// What must be equal when a run was stopped and continued: everything but wall times and the
/// command line.
#pragma once

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "common/formats/hdf5_file.hpp"
#include "common/formats/summary_file.hpp"
#include "tests/support/same_bits.hpp"

namespace ice::test {

inline std::string bytes_of(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
}

/// All growing datasets of run.h5 (run_file.hpp lists them).
inline void check_same_run_file(const std::filesystem::path& expected,
                                const std::filesystem::path& actual,
                                const std::vector<int>& tracked) {
    const Hdf5File a(expected, Hdf5File::Mode::read), b(actual, Hdf5File::Mode::read);
    std::vector<std::string> names{"/time"};
    for (const char* name : {"contact_force", "friction_force", "force", "moment", "pose",
                             "contacts", "moving_floes", "max_overlap", "kinetic_energy"})
        names.push_back(std::string("/ship/") + name);
    if (a.has("/ship/velocity"))  // a free ship
        for (const char* name : {"/ship/velocity", "/ship/angles", "/ship/thrust",
                                 "/ship/tow_force", "/frames/ship_orientation"})
            names.emplace_back(name);
    for (const char* name : {"frame_time", "position", "orientation", "velocity",
                             "angular_velocity", "contact_force", "state", "ship_position"})
        names.push_back(std::string("/frames/") + name);
    for (const char* name : {"contact_force", "friction_force"})
        names.push_back(std::string("/regions/") + name);
    for (const char* name :
         {"center", "normal", "area", "length", "force_mean", "force_p99", "force_max", "region"})
        names.push_back(std::string("/panels/") + name);
    for (const int id : tracked) names.push_back("/tracked/" + std::to_string(id));
    for (const std::string& name : names) {
        CAPTURE(name);
        CHECK(a.shape(name) == b.shape(name));
        CHECK(same_bits(a.read<double>(name), b.read<double>(name)));
    }
}

inline void check_same_summary(const std::filesystem::path& expected,
                               const std::filesystem::path& actual) {
    auto a = read_json_numbers(expected), b = read_json_numbers(actual);
    for (auto* numbers : {&a, &b})
        std::erase_if(*numbers, [](const auto& entry) {
            return entry.first == "wall_s" || entry.first == "realtime_factor" ||
                   entry.first == "threads" || entry.first.starts_with("stage");
        });
    CHECK(a.size() > 20);
    CHECK(a.size() == b.size());
    for (const auto& [key, value] : a) {
        CAPTURE(key);
        CHECK(same_bits<double>({value}, {b.at(key)}));
    }
    const Summary s = read_summary(expected), t = read_summary(actual);
    CHECK(s.state_hash == t.state_hash);
    CHECK(s.status == t.status);
    CHECK(s.warnings == t.warnings);
}

/// Two run folders.
inline void check_same_runs(const std::filesystem::path& expected,
                            const std::filesystem::path& actual, const std::vector<int>& tracked) {
    CHECK(bytes_of(expected / "forces.csv") == bytes_of(actual / "forces.csv"));
    for (const int id : tracked) {
        const std::string name = "floe_" + std::to_string(id) + ".csv";
        CHECK(bytes_of(expected / name) == bytes_of(actual / name));
    }
    check_same_run_file(expected / "run.h5", actual / "run.h5", tracked);
    check_same_summary(expected / "summary.json", actual / "summary.json");
}

}  // namespace ice::test
