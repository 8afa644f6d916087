// SPDX-License-Identifier: GPL-3.0-or-later
/// Reading strangers' files with libraries that were not made for them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

namespace ice {

/// Limits of memory and time for reading a file; far more than any sound file needs.
struct ReadBounds {
    double seconds = 10.0;                         ///< of processor time [s]
    std::uint64_t bytes = std::uint64_t{1} << 30;  ///< of memory beyond that in use [bytes]

    /// 10 s and 5 s per MB; 1 GiB and 64 bytes per byte.
    /// @param size  of the file, unpacked [bytes]
    static ReadBounds for_size(std::uint64_t size);
};

/// Does `read` once in a child process and throws where that throws an Error, crashes, never ends
/// or fills the memory: assimp 5.2 and HDF5 1.10 do so on some damaged files
/// (tests/fuzz/README.md). After success there, the caller reads the file itself. The child can
/// grow no file, leaves no core and its stderr is thrown away.
///
/// A crash becomes a message. This is no sandbox: a file that takes over the library in the child
/// would act with the user's rights.
///
/// @param file  for the message
/// @param read  must start no threads; its changes are lost
/// @throws Error that `read` threw; (exit code 2) when reading does not end by itself or is out of
///         bounds; (exit code 1) when the system gives no process
void rehearse(const std::filesystem::path& file, const ReadBounds& bounds,
              const std::function<void()>& read);

}  // namespace ice
