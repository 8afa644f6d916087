// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <string>

#include "tests/postprocess/make_folder.hpp"

namespace ice::test {

/// A run folder at speed u with the resistance given, of which the bow has 60 %, the bottom 30 %;
/// 10 % are friction on each.
inline void write_run(const std::filesystem::path& folder, double speed, double mu, int seed,
                      double resistance, const std::string& more = "") {
    std::filesystem::create_directories(folder);
    Summary s = *make_folder().summary;
    s.resistance = {resistance, 0.8 * resistance, 0.2 * resistance, 1.0, 2.0, 7.0};
    s.lindqvist_submersion = 500.0 + 100.0 * speed;
    s.formulas = {{"Lindqvist 1989", "submersion", 500.0 + 100.0 * speed, false},
                  {"Jeong 2010", "buoyancy", 200.0, false},
                  {"Jeong 2010", "clearing", 80.0 * speed, false},
                  {"Jeong 2010", "buoyancy + clearing", 200.0 + 80.0 * speed, false}};
    s.regions.clear();
    const auto add = [&](const char* region, double contact, double friction) {
        const auto force = [&](double share) {
            return std::array<double, 3>{-share * resistance, 0.0, 1.0};
        };
        s.regions[region] = {1, 1.0, force(contact + friction), force(contact), force(friction)};
    };
    add("bow", 0.5, 0.1);
    add("Bottom_aft", 0.2, 0.1);
    add("hull", 0.1, 0.0);
    write_bytes(folder / "summary.json", summary_text(s));
    write_bytes(folder / "case.resolved.cfg",
                fmt::format("title = \"t{}\"\n[simulation]\nseed = {}\n[hull]\nspeed = {}\n"
                            "spheres = \"/a/b/hull.spheres.h5\"\n[contact]\n"
                            "friction_ship_ice = {}\n{}[output]\naverage_from = {}\n",
                            speed, seed, speed, mu, more, 10.0 * speed));
}

/// Two speeds, two frictions, three seeds: resistance 1000 u + 100 mu + {-1, 0, 1}.
inline void write_grid(const TempFolder& folder) {
    for (const double speed : {0.5, 1.0})
        for (const double mu : {0.1, 0.2})
            for (const int seed : {1, 2, 3})
                write_run(folder / fmt::format("runs/u{}m{}s{}", speed, mu, seed), speed, mu, seed,
                          1000.0 * speed + 100.0 * mu + seed - 2.0);
}

}  // namespace ice::test
