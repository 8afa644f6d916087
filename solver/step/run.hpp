// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "common/formats/summary_file.hpp"
#include "solver/step/step.hpp"

namespace ice {

/// What the caller of a run may watch and decide.
struct RunOptions {
    std::filesystem::path folder;  ///< run folder; created
    std::string command_line;
    bool verify = false;  ///< every step must balance (balance.hpp); the worst is in the summary
    /// Called after every step with (fraction done, world); false ends the run as "interrupted".
    std::function<bool(double, const World&)> keep_going = [](double, const World&) {
        return true;
    };
};

/// A case made ready: sphere sets read, floes placed.
World build_world(const Case& parameters);

/// Creates the run folder and removes an older run's files from it.
/// @throws Error (exit code 1) when it cannot be created
void make_run_folder(const std::filesystem::path& folder);

/// Runs a world to its case's duration and writes the run folder.
///
/// A body whose position is no longer finite ends the run with an Error (exit code 1) naming step
/// and floe; the folder then holds what was computed, with the status "failed".
Summary run(World& world, const RunOptions& options);

}  // namespace ice
