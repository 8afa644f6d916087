// SPDX-License-Identifier: GPL-3.0-or-later
/// A run folder as icesolve leaves it (docs/contract.md, section 5).
#pragma once

#include <filesystem>
#include <optional>

#include "common/formats/run_file.hpp"
#include "common/formats/summary_file.hpp"

namespace ice::read {

/// Everything the reports need of one run.
struct RunFolder {
    std::filesystem::path path;      ///< the folder
    RunData data;                    ///< of run.h5, or of run.h5.part when the run was killed
    std::optional<Summary> summary;  ///< none when the run ended before it wrote summary.json
};

/// Reads a run folder.
///
/// @param path the folder, or any file inside it
/// @throws Error (exit code 2) naming the file when there is no folder or no readable run.h5.
RunFolder read_run_folder(const std::filesystem::path& path);

/// The file summary.json of a run, given the folder or the file itself.
/// @throws Error (exit code 2) when there is none.
std::filesystem::path find_summary(const std::filesystem::path& path);

/// The summary of a run, given the folder or the file. That of an ensemble also has the warnings
/// of its members that affect their mean, "seed 3: ..."; the ensemble's own leave out the trends
/// that chance explains. Members without a summary.json are passed over.
/// @throws Error (exit code 2) when there is none.
Summary read_with_members(const std::filesystem::path& path);

}  // namespace ice::read
