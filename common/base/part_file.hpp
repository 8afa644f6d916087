// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace ice {

/// Brings a file's content, or a folder's names, to the disk now (fsync), so that
/// a power cut cannot take them away. Some file systems cannot, which is no failure.
/// @return false with errno when it fails
bool bring_to_disk(const std::filesystem::path& path);

/// Gives a finished file its final name so that neither a kill nor a power cut leaves less than the
/// whole file under that name: the content of `part` is brought to the disk before the rename
/// (fsync), the rename after it.
/// @throws Error (exit code 1) naming `final_path` when one of them fails; `part` stays
void keep_file(const std::filesystem::path& part, const std::filesystem::path& final_path);

/// Name of an output while it is written: "x.part" beside the final "x".
///
/// keep() renames it to its final name; otherwise the destructor removes it, so that a failed
/// program leaves nothing half-written.
class PartFile {
public:
    /// Makes no file; the caller opens path(). @throws Error (exit code 1) where the final name is
    /// that of something else than a file
    explicit PartFile(std::filesystem::path final_path);
    ~PartFile();
    PartFile(const PartFile&) = delete;
    PartFile& operator=(const PartFile&) = delete;

    const std::filesystem::path& path() const { return part_; }
    /// keep_file(), once, after the caller has closed the file. @throws Error (exit code 1)
    void keep();

private:
    std::filesystem::path final_, part_;
    bool kept_ = false;
    int slot_ = -1;  // of the names that remove_part_files() removes
};

/// Removes the files of all PartFiles there are: for a program that ends without unwinding. Takes
/// no memory and may be called from a signal handler. Knows 16 files at a time.
void remove_part_files() noexcept;

/// Writes a whole text file through a PartFile.
/// @throws Error (exit code 1) naming the path when it cannot be written completely.
void write_text_file(const std::filesystem::path& path, const std::string& text);

}  // namespace ice
