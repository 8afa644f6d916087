// SPDX-License-Identifier: GPL-3.0-or-later
/// Stopping a run and continuing it to the same bits.
#pragma once

#include <filesystem>
#include <string>

#include "solver/run/state_fields.hpp"

namespace ice {

/// A run as a checkpoint left it, its world aside.
struct SavedRun {
    Recorder recorder;  ///< without files: resume() opens them
    RecordPosition position;
    RunProgress progress;
    std::filesystem::path folder;  ///< where the checkpoint lies, and with it the run's files
    std::string created_by;        ///< the program that wrote it
};

/// Where the rows of run.h5 are that a checkpoint counts.
enum class SavedRows {
    beside,      ///< in files of their own, which a kill at any later moment leaves whole
    in_run_file  ///< in run.h5 only, which takes less room: for a run that ends here
};

/// Writes all that a run carries on to `path`. The recorder's files are flushed first, so that they
/// hold the rows that the checkpoint counts. A kill at any moment leaves the older checkpoint
/// whole.
/// @throws Error (exit code 1) naming the file when the disk is full
void write_checkpoint(const std::filesystem::path& path, World& world, Recorder& recorder,
                      RunProgress& progress, SavedRows rows = SavedRows::beside);

/// Reads a checkpoint into a world just built from the case. Touches no other file.
///
/// The case must be that of the checkpoint but for simulation.duration; sphere sets are compared by
/// their content, so the files may have moved.
///
/// @throws Error (exit code 2): missing, damaged, newer format; another case, naming the key; a
///         duration that ends before the checkpoint.
SavedRun read_checkpoint(const std::filesystem::path& path, World& world);

}  // namespace ice
