// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace ice {

/// The most that gunzip() unpacks [bytes]: 1 GiB, some 20 million triangles of binary STL. A gzip
/// file can be a thousandth of its content, so a small one could otherwise fill the memory. A
/// larger value lets such a file take more, a smaller one refuses large meshes.
inline constexpr std::uint64_t kUnpackedLimit = std::uint64_t{1} << 30;

/// Whether the file's name ends in ".gz", in small or capital letters.
bool is_gzip_name(const std::filesystem::path& file);

/// The file's name without folder, without ".gz" and without its format: "a/hull.stl.gz" -> "hull".
std::string mesh_stem(const std::filesystem::path& file);

/// The bytes that a gzip file holds, checked against its check sum.
/// @param limit  of the result [bytes]
/// @throws Error (exit code 2) naming the file: unreadable, not gzip, damaged, cut short, larger
///         than `limit` when unpacked
std::vector<char> gunzip(const std::filesystem::path& file, std::uint64_t limit = kUnpackedLimit);

}  // namespace ice
