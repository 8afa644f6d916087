// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/base/file_turn.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <thread>

namespace ice {

namespace {

// Time between two attempts to take the lock [ms]. It is short beside the write of a chunk: a
// longer one lets readers wait, a shorter one only calls the system more often.
constexpr auto kPause = std::chrono::milliseconds(1);

}  // namespace

FileTurn::FileTurn(const std::filesystem::path& file, Kind kind, std::chrono::seconds longest_wait)
    : file_(::open(file.c_str(), (kind == Kind::read ? O_RDONLY : O_RDWR) | O_CLOEXEC)) {
    if (file_ < 0) return;
    struct flock whole = {};
    whole.l_type = kind == Kind::read ? F_RDLCK : F_WRLCK;
    whole.l_whence = SEEK_SET;
    // Asked again and again, not F_OFD_SETLKW: a wait within the system has no time limit.
    const auto end = std::chrono::steady_clock::now() + longest_wait;
    // locks of the open file, not of the process: two threads of one program exclude each
    // other, too
    while (::fcntl(file_, F_OFD_SETLK, &whole) != 0) {
        // All other faults mean a file system without locks: the file is used without one.
        const bool is_taken = errno == EAGAIN || errno == EACCES;
        if (!is_taken || std::chrono::steady_clock::now() > end) return;
        std::this_thread::sleep_for(kPause);
    }
}

FileTurn::~FileTurn() {
    if (file_ >= 0) ::close(file_);
}

}  // namespace ice
