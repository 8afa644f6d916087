// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "common/cli/command_line.hpp"

namespace ice {

/// Command line of icesolve.
struct Options {
    std::string case_file, out, explain, restart, simd = "auto";
    std::string picture, fresh_case;
    std::vector<std::string> overrides, fresh;
    std::map<std::string, std::string> of_mesh;  // options of spherize that --new passes on
    int threads = 0, seeds = 0;
    std::int64_t hash_every = 0;
    double checkpoint_every = 0.0, autosave = 300.0;  // [s] simulated, [s] of wall time
    bool check = false, schema = false, defaults = false, json = false, verify = false,
         no_report = false, allow_overlap = false, overwrite = false;
    MessageOptions messages;
};

/// Tells the command line which options there are; the rest of the text is `icesolve --help`.
void declare_options(CLI::App& app, Options& o);

}  // namespace ice
