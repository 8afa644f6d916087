// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace ice {

/// Name of an output while it is written: "x.part" beside the final "x".
///
/// keep() renames it to its final name; otherwise the destructor removes it, so that a failed
/// program leaves nothing half-written.
class PartFile {
public:
    explicit PartFile(std::filesystem::path final_path);
    ~PartFile();
    PartFile(const PartFile&) = delete;
    PartFile& operator=(const PartFile&) = delete;

    const std::filesystem::path& path() const { return part_; }
    /// @throws Error (exit code 1) when the rename fails.
    void keep();

private:
    std::filesystem::path final_, part_;
    bool kept_ = false;
};

/// Writes a whole text file through a PartFile.
/// @throws Error (exit code 1) naming the path when it cannot be written completely.
void write_text_file(const std::filesystem::path& path, const std::string& text);

}  // namespace ice
