// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace ice::test {

/// A file of the given ending and bytes in the temporary folder, removed with the object.
class TemporaryFile {
public:
    TemporaryFile(const std::string& suffix, const std::string& bytes) {
        static int number = 0;
        path_ = std::filesystem::temp_directory_path() / ("ice-read-" + std::to_string(::getpid()) +
                                                          "-" + std::to_string(++number) + suffix);
        std::ofstream(path_, std::ios::binary) << bytes;
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile() { std::filesystem::remove(path_); }
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

}  // namespace ice::test
