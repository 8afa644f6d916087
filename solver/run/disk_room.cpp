// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/run/disk_room.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <limits>
#include <string>
#include <vector>

#include "common/formats/run_file.hpp"
#include "solver/record/long_series.hpp"

namespace ice {

namespace {

// Rows between two checks of the disk [bytes]. A larger value reserves as much more room, a smaller
// one checks the disk more often.
constexpr std::uint64_t kStride = 1 << 16;
// HDF5's blocks and indices, summary.json and run.log [bytes]. All bounds here are generous: a
// larger value stops a run a little early, a smaller one leaves a file cut.
constexpr std::uint64_t kEnd = 1 << 19;
// A checkpoint [bytes], of it per body and per contact: a run of 5 floes has one of 53 kB.
constexpr std::uint64_t kFields = 1 << 16, kPerBody = 400, kPerContact = 400;
// Of a checkpoint per step [bytes]: statistics remember forces of LongSeries::kMost steps.
constexpr std::uint64_t kPerStep = 64;
// Rows in the CSV files between two checks [bytes]: text takes at most 25 bytes for the 8 of a
// number, and the streams buffer some.
constexpr std::uint64_t kTextStride = 4 * kStride, kTextBuffer = 1 << 14;
constexpr const char* kRows = "run.h5.part";

std::uint64_t bytes_of(const std::filesystem::path& file) {
    std::error_code error;
    const auto size = std::filesystem::file_size(file, error);
    return error ? 0 : size;
}

// forces.csv and those of tracked floes, finished or not
std::vector<std::filesystem::path> csv_files(const std::filesystem::path& folder) {
    std::error_code ignored;
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
        const std::string name = entry.path().filename().string();
        if (name.ends_with(".csv") || name.ends_with(".csv.part")) files.push_back(entry.path());
    }
    return files;
}

std::uint64_t largest_file(const std::filesystem::path& folder) {
    std::error_code ignored;
    std::uint64_t largest = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder, ignored))
        if (const auto size = entry.file_size(ignored); !ignored)
            largest = std::max<std::uint64_t>(largest, size);
    return largest;
}

// Bytes that the limit of a single file (ulimit -f) leaves for the largest one.
std::uint64_t below_file_limit(const std::filesystem::path& folder) {
    rlimit limit{};
    if (getrlimit(RLIMIT_FSIZE, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
        return std::numeric_limits<std::uint64_t>::max();
    return limit.rlim_cur - std::min<std::uint64_t>(limit.rlim_cur, largest_file(folder));
}

std::uint64_t free_space(const std::filesystem::path& folder) {
    std::error_code error;
    const auto space = std::filesystem::space(folder, error);
    return error ? std::numeric_limits<std::uint64_t>::max() : space.available;
}

bool is_want_of_room(int reason) { return reason == ENOSPC || reason == EDQUOT || reason == EFBIG; }

// Gives a file its next blocks, so that no later write into it finds the disk full; its
// length stays. 0, or why not.
int allocate_ahead(const std::filesystem::path& path, std::uint64_t bytes) {
    const int file = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
    if (file < 0) return errno;
    struct stat state {};
    int reason = ::fstat(file, &state) == 0 ? 0 : errno;
    // beyond the present end, without moving it
    const auto end = static_cast<off_t>(bytes) + state.st_size;
    if (reason == 0 && ::fallocate(file, FALLOC_FL_KEEP_SIZE, 0, end) != 0) reason = errno;
    ::close(file);
    return reason;
}

}  // namespace

bool DiskRoom::could_hold(std::uint64_t rows, std::uint64_t text_rows, std::uint64_t end) {
    if (!can_hold_) return true;
    // The rows' blocks are allocated in their own files; the rows of the end of a run are
    // reserved in a file without a name.
    int reason = allocate_ahead(folder_ / kRows, rows);
    for (const auto& path : csv_files(folder_))
        if (reason == 0) reason = allocate_ahead(path, text_rows);
    if (reason == 0 && end > held_bytes_) {
        if (held_ < 0) held_ = ::open(folder_.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
        if (held_ < 0 || ::fallocate(held_, 0, 0, static_cast<off_t>(end)) != 0) reason = errno;
    }
    if (is_want_of_room(reason)) return false;
    can_hold_ = reason == 0;  // not on this file system
    held_bytes_ = std::max(held_bytes_, end);
    return true;
}

DiskRoom::~DiskRoom() {
    release();
    // returns the blocks that the files did not need
    std::vector<std::filesystem::path> files = csv_files(folder_);
    files.insert(files.end(), {folder_ / "run.h5", folder_ / kRows});
    for (const std::filesystem::path& path : files)
        if (const int file = ::open(path.c_str(), O_RDWR | O_CLOEXEC); file >= 0) {
            struct stat state {};
            if (::fstat(file, &state) == 0 && ::ftruncate(file, state.st_size) != 0)
                looked_ = false;  // they stay allocated, without harm
            ::close(file);
        }
}

void DiskRoom::release() {
    if (held_ >= 0) ::close(held_);
    held_ = -1;
    held_bytes_ = 0;
    can_hold_ = false;
}

void DiskRoom::saved() { saved_bytes_ = bytes_of(folder_ / kRows); }

bool DiskRoom::is_used_up() const { return held_ >= 0 && free_space(folder_) < held_bytes_; }

bool DiskRoom::is_short(const Recorder& recorder, const World& world, bool saves) {
    // Asking the file system costs time: only when rows, a checkpoint or many bytes are due.
    const std::uint64_t waiting = recorder.waiting_bytes();
    if (looked_ && !saves && !recorder.is_about_to_write() && waiting >= waiting_ &&
        waiting - waiting_ < kStride)
        return false;
    looked_ = true;
    waiting_ = waiting;
    const std::uint64_t bodies = world.scene.bodies.size();
    const auto kept =
        std::min<std::uint64_t>(LongSeries::kMost, static_cast<std::uint64_t>(world.steps));
    const std::uint64_t checkpoint = kFields + kPerBody * bodies +
                                     kPerContact * world.constraints.size() + kPerStep * kept +
                                     world.edge.bytes_of_gone();
    const std::uint64_t more =
        waiting + 2 * kStride + kFrameFloeBound * bodies;  // at the next check
    // a checkpoint comes with a copy of the rows since the last one
    const std::uint64_t file = bytes_of(folder_ / kRows);
    const std::uint64_t copy = saves ? file - std::min(file, saved_bytes_) + kEnd : 0;
    const std::size_t tables = std::max<std::size_t>(csv_files(folder_).size(), 1);
    const std::uint64_t rows = more + kEnd, text_rows = kTextStride / tables + kTextBuffer;
    const std::uint64_t end = checkpoint + more + copy;
    if (!could_hold(rows, text_rows, end) || below_file_limit(folder_) < rows) return true;
    return !can_hold_ && free_space(folder_) < rows + tables * text_rows + end;
}

}  // namespace ice
