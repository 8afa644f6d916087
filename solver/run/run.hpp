// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "common/formats/summary_file.hpp"
#include "solver/run/checkpoint.hpp"
#include "solver/step/step.hpp"

namespace ice {

/// The caller's hooks and options of a run.
struct RunOptions {
    std::filesystem::path folder;  ///< run folder; created. Claim it before (RunFolder): files of
                                   ///< an older run are replaced, not removed
    std::string command_line;
    /// Simulated time between checkpoints [s]; 0: when interrupted, and every
    /// checkpoint_wall_seconds until the run ends
    double checkpoint_every = 0.0;
    SavedRun* saved = nullptr;                 ///< resume this run; its recorder is taken over
    std::vector<Warning> start_warnings = {};  ///< of inputs, start and water
    bool verify =
        false;  ///< every step must balance (measure_imbalance.hpp); the worst is in the summary
    /// Called after every step with (fraction done [-], world); false ends the run as
    /// "interrupted", with a checkpoint.
    std::function<bool(double, const World&)> keep_going = [](double, const World&) {
        return true;
    };
    /// Warnings of check_course(), for the summary: of this duration, so that no checkpoint carries
    /// them.
    std::vector<Warning> course_warnings = {};
    double checkpoint_wall_seconds = 300.0;  ///< [s], where checkpoint_every is 0
};

/// Makes a case ready: reads its sphere sets and fields, places hull and floes.
/// @throws Error (exit code 1 or 2) for files that are missing, faulty or do not fit the case
World build_world(const Case& parameters);

/// Runs a world to its case's duration and writes the run folder.
///
/// A resumed run is bit-identical to an uninterrupted one: the files of its folder are cut
/// to the checkpoint's rows and continued, or copied up to there into another folder. Files that
/// are missing begin at the checkpoint, with a warning; the summary is of the whole run all the
/// same. Only wall times (sums over the programs) and the warnings of that kind differ.
///
/// Where the disk is almost full the run stops in time: files, summary (status "failed") and a
/// checkpoint are complete. Where that comes too late (another program took the room) an Error
/// (exit code 1) names the file; the .part files and the last checkpoint stay.
///
/// A body whose position is no longer finite ends the run with an Error (exit code 1) naming step
/// and floe; the folder then holds the results so far, with the status "failed".
Summary run(World& world, const RunOptions& options);

}  // namespace ice
