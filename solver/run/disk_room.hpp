// SPDX-License-Identifier: GPL-3.0-or-later
/// When to stop before the disk is full.
#pragma once

#include <cstdint>
#include <filesystem>

#include "solver/record/recorder.hpp"
#include "solver/step/step.hpp"

namespace ice {

/// Decides when a run has to stop for want of room. A file that a full disk cuts off cannot be
/// mended; a run that stops with some room left completes its files and writes a checkpoint.
///
/// Other programs may fill the disk at once, so that room is held where the file system can
/// (fallocate): for rows within run.h5 and the CSV files, for the rest by a file without a name,
/// which ends with the program, however that ends. Elsewhere the free space is read, without
/// quotas. The limit of a single file (ulimit -f) counts, too.
class DiskRoom {
public:
    explicit DiskRoom(std::filesystem::path folder) : folder_(std::move(folder)) {}
    ~DiskRoom();
    DiskRoom(const DiskRoom&) = delete;
    DiskRoom& operator=(const DiskRoom&) = delete;

    /// Is there less room than the waiting rows, a checkpoint and the end of the files may take? To
    /// be called before every step; reads the disk before rows are written and once per some
    /// 64 kB of them.
    /// @param saves  a checkpoint with a copy of its rows comes next: checks now, with the copy
    bool is_short(const Recorder& recorder, const World& world, bool saves = false);
    /// A checkpoint was written: the next one copies the rows from here on.
    void saved();
    /// True where less is free than is held: a checkpoint that does not fit beside it fits into it.
    bool is_used_up() const;
    /// Releases the space held for a checkpoint and the end of the files: for a run that ends.
    void release();

private:
    bool could_hold(std::uint64_t rows, std::uint64_t text_rows, std::uint64_t end);

    std::filesystem::path folder_;
    int held_ = -1;  // the file
    std::uint64_t held_bytes_ = 0;
    std::uint64_t saved_bytes_ = 0;  // of run.h5.part at the last checkpoint
    bool looked_ = false, can_hold_ = true;
    std::uint64_t waiting_ = 0;  // at the last check
};

}  // namespace ice
