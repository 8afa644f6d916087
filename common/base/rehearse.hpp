// SPDX-License-Identifier: GPL-3.0-or-later
/// Reading strangers' files with libraries that were not made for them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

namespace ice {

/// Limits of memory and time for reading a file; far more than any sound file needs.
struct ReadBounds {
    double seconds = 10.0;                         ///< of processor time [s]
    std::uint64_t bytes = std::uint64_t{1} << 30;  ///< of memory beyond that in use [bytes]

    /// 10 s and 5 s per MB; 1 GiB and 64 bytes per byte.
    /// @param size  of the file, unpacked [bytes]
    static ReadBounds for_size(std::uint64_t size);
};

/// Does `read` in a child process and returns its bytes; throws where it throws, crashes, never
/// ends or fills the memory: assimp 5.2 and HDF5 1.10 do so on some damaged files
/// (tests/fuzz/README.md). The child can grow no file, leaves no core; its stderr is thrown away.
///
/// A crash becomes a message. This is no sandbox: a file that takes over the library in the child
/// would act with the user's rights.
///
/// @param file  for the message
/// @param read  must start no threads; its changes are lost. The bytes count among bounds.bytes
/// @throws Error that `read` threw; (exit code 2) when reading does not end by itself or is out of
///         bounds; (exit code 1) when the system gives no process
/// @throws std::runtime_error with the text of any other exception of `read`: a fault of ours
std::string read_in_child(const std::filesystem::path& file, const ReadBounds& bounds,
                          const std::function<std::string()>& read);

/// Does `read` in a child process for its errors alone: as read_in_child(), for readers whose
/// answer is too rich for bytes. After success the caller reads the file itself.
void rehearse(const std::filesystem::path& file, const ReadBounds& bounds,
              const std::function<void()>& read);

}  // namespace ice
