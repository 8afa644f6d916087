// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <fstream>
#include <string_view>

#include "common/base/part_file.hpp"

namespace ice {

/// A file written piece by piece under its part name; it gets its final name by keep().
class OutputFile {
public:
    explicit OutputFile(const std::filesystem::path& path);

    void write(std::string_view bytes);  ///< faults show in close()
    /// @throws Error (exit code 1) naming the file when not everything reached the disk.
    void close();
    /// After close(): renames to the final name.
    void keep() { part_.keep(); }
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
    PartFile part_;
    std::ofstream out_;
};

}  // namespace ice
