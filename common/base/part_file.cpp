// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/base/part_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstring>
#include <fstream>
#include <system_error>

#include "common/base/error.hpp"

namespace ice {

bool bring_to_disk(const std::filesystem::path& path) {
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) return false;
    // Some file systems have no fsync (EINVAL). Nothing more can be done for a file there, so that
    // this is no failure.
    const bool good = ::fsync(file) == 0 || errno == EINVAL;
    // close() may change errno.
    const int reason = errno;
    ::close(file);
    errno = reason;
    return good;
}

void keep_file(const std::filesystem::path& part, const std::filesystem::path& final_path) {
    // content first, then the name: the final name belongs to a whole file at every moment
    if (!bring_to_disk(part))
        throw run_failed(final_path.string(),
                         std::string("cannot be brought to the disk: ") + std::strerror(errno),
                         "check that the disk is not full");
    std::error_code error;
    std::filesystem::rename(part, final_path, error);
    if (error)
        throw run_failed(final_path.string(), "cannot rename the finished file: " + error.message(),
                         "check that the folder is writable");
    // after a power cut the old name may be back, with the whole content: nothing is lost
    const auto folder = final_path.parent_path();
    bring_to_disk(folder.empty() ? std::filesystem::path(".") : folder);
}

namespace {

// Names that a signal handler can read at any time: fixed places, given and taken by a flag.
struct Slot {
    std::atomic<int> state{0};  // 0 free, 1 being named, 2 in use
    char path[PATH_MAX] = "";
};
// Files that are written at the same time: a program has three or four. Beyond 16 a file is still
// written, but an abrupt end leaves its part.
constexpr std::size_t kSlots = 16;

// One table for the process, since a signal handler gets nothing but the signal's number. It is
// made before the program runs (constinit): a handler may not wait for that.
std::array<Slot, kSlots>& slots() {
    static constinit std::array<Slot, kSlots> table;
    return table;
}

int take_slot(const std::string& path) {
    if (path.size() >= PATH_MAX) return -1;
    for (std::size_t k = 0; k < kSlots; ++k) {
        Slot& slot = slots()[k];
        int free = 0;
        if (!slot.state.compare_exchange_strong(free, 1)) continue;
        std::memcpy(slot.path, path.c_str(), path.size() + 1);
        // last: a handler that interrupts the copy sees state 1 and leaves the name alone
        slot.state = 2;
        return static_cast<int>(k);
    }
    return -1;  // as many as that: the name will not be known
}

void give_slot(int slot) {
    if (slot >= 0) slots()[static_cast<std::size_t>(slot)].state = 0;
}

}  // namespace

void remove_part_files() noexcept {
    for (const Slot& slot : slots())
        if (slot.state == 2) ::unlink(slot.path);
}

PartFile::PartFile(std::filesystem::path final_path)
    : final_(std::move(final_path)), part_(final_.string() + ".part") {
    std::error_code ignored;
    if (std::filesystem::is_directory(final_, ignored))
        throw run_failed(final_.string(), "is a folder", "give the name of a file");
    // a rename would replace a device such as /dev/null by a file
    if (std::filesystem::exists(final_, ignored) &&
        !std::filesystem::is_regular_file(final_, ignored))
        throw run_failed(final_.string(), "exists and is no file: it would be replaced",
                         "give the name of a file");
    slot_ = take_slot(part_.string());
}

PartFile::~PartFile() {
    std::error_code ignored;
    if (!kept_) std::filesystem::remove(part_, ignored);
    give_slot(slot_);
}

void PartFile::keep() {
    keep_file(part_, final_);
    kept_ = true;
    // the name is free for others
    give_slot(slot_);
    slot_ = -1;
}

void write_text_file(const std::filesystem::path& path, const std::string& text) {
    PartFile part(path);
    std::ofstream out(part.path(), std::ios::binary);
    out << text;
    out.close();
    if (!out)
        throw run_failed(path.string(), "cannot be written",
                         "check that the folder exists, is writable and the disk is not full");
    part.keep();
}

}  // namespace ice
