// SPDX-License-Identifier: GPL-3.0-or-later
/// Whose a run folder is, and which of its files are the solver's.
#pragma once

#include <filesystem>
#include <string>

namespace ice {

/// Name of the checkpoint in a run folder.
constexpr const char* kCheckpointName = "checkpoint.h5";

/// How a program treats a folder that is not empty.
enum class Existing {
    refuse,   ///< ends with an Error
    replace,  ///< removes an older run's files; other files stay
    go_on     ///< changes nothing: the run resumes from a checkpoint in this folder
};

/// Command lines that an Error about an existing folder prints.
struct FolderCommands {
    std::string replace;  ///< computes the run all the same, e.g. "icesolve a.cfg --overwrite"
    std::string go_on;    ///< resumes from the folder's checkpoint
};

/// A run folder that belongs to this program as long as the object lives.
///
/// Two programs never write one folder: its run.log is locked (flock), which the system ends with
/// the program, however that ends. File systems without locks are served without one.
class RunFolder {
public:
    /// Creates the folder, locks it and, with Existing::replace, removes an older run from it. Is
    /// to be called when all that the run needs has been read and checked. An empty folder is
    /// never refused.
    /// @throws Error exit code 2 when another program writes this run, or the folder holds anything
    ///         and `existing` is refuse; 1 when it cannot be created
    RunFolder(std::filesystem::path folder, Existing existing, const FolderCommands& commands = {});
    ~RunFolder();
    RunFolder(const RunFolder&) = delete;
    RunFolder& operator=(const RunFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
    int lock_ = -1;
};

/// Folder of a case's run where none is given: results/<stem of the case file>, or of its folder
/// where the file is called case.cfg.
std::filesystem::path default_run_folder(const std::filesystem::path& case_file);

/// True where a folder holds a run of its own, whole or not; an ensemble's summary is none.
bool holds_single_run(const std::filesystem::path& folder);

/// True for the folder of a member of an ensemble, "seed-3".
bool is_member_folder(const std::filesystem::path& path);

/// Removes all that icesolve writes into a run folder, but for run.log, which holds the lock.
void remove_run(const std::filesystem::path& folder);

/// Removes summary and report of a finished run that is resumed: they would be out of date.
void remove_results(const std::filesystem::path& folder);

/// Removes the .part files of a run.
void remove_parts(const std::filesystem::path& folder);

}  // namespace ice
