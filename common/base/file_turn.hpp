// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <filesystem>

namespace ice {

/// A file that one program writes again and again while others read it: the writer waits for
/// readers to end, and readers for the writer, so that a reader never sees half of a change.
///
/// An advisory lock on the open file (fcntl, F_OFD_SETLK), which the system ends with the program,
/// however that ends. It binds only programs that take a FileTurn; HDF5's own locks are others.
/// Nobody waits longer than ten seconds, or than the caller allows: a stopped reader must not stop
/// a run of days. Files that are missing and file systems without locks are served without one.
class FileTurn {
public:
    /// Readers share the file, a writer has it alone.
    enum class Kind { read, write };
    /// Waits for the turn and holds it until the destructor. Throws nothing: without a turn the
    /// file is used all the same.
    /// @param longest_wait  [s]; 0: one attempt
    FileTurn(const std::filesystem::path& file, Kind kind,
             std::chrono::seconds longest_wait = std::chrono::seconds(10));
    ~FileTurn();
    FileTurn(const FileTurn&) = delete;
    FileTurn& operator=(const FileTurn&) = delete;

private:
    int file_ = -1;
};

}  // namespace ice
