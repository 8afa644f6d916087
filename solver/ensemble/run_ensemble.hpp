// SPDX-License-Identifier: GPL-3.0-or-later
/// Several runs of one case, each with a seed of its own, and the mean of their means.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/formats/summary_file.hpp"

namespace ice {

/// Options of `icesolve CASE --seeds N`.
struct EnsembleOptions {
    std::string case_file;
    std::vector<std::string> overrides;     ///< of the case, "key=value"
    int members = 0;                        ///< number of runs, at least 1
    std::filesystem::path folder;           ///< members in seed-1, seed-2, ...
    bool overwrite = false;                 ///< first remove the runs in the folder
    std::vector<std::string> member_words;  ///< of the command line, for every member
    std::string command_line;
    std::string command_beside, command_replace;  ///< printed where the folder holds a single run
};

struct EnsembleResult {
    Summary summary;  ///< of the finished members; also in the folder's summary.json
    int code = 0;     ///< of the member that ended the ensemble, 0 when all are finished
};

/// Runs the members one after the other, each a program icesolve of its own, and writes the
/// folder's summary.json after each: an interrupt, or a failed member, keeps finished members.
///
/// The folder is locked as a run's is (RunFolder), its run.log holds the messages.
///
/// Seeds count from simulation.seed, or from 1 where that is 0. A field whose specification makes
/// another one with another seed is made anew for every member (member_field.hpp). Where no field
/// is, floes are moved by simulation.jitter; where that is 0, by a hundredth of the smallest ice
/// sphere's radius, which no start refuses: floes that touch then overlap by no more than is
/// tolerated (check_start.hpp).
///
/// In a folder with an ensemble of the same case the command resumes: finished members are
/// kept, one with a checkpoint resumes from it, and `members` may have grown.
/// @throws Error (exit code 2) for a folder with a single run, or with members of another case,
///         unless `overwrite`; for one that another program writes; for a bad case. (exit code 1)
///         when icesolve or a file cannot be started or written.
EnsembleResult run_ensemble(const EnsembleOptions& options);

}  // namespace ice
