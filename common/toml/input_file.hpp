// SPDX-License-Identifier: GPL-3.0-or-later
/// A TOML input as a whole: its text, and all mistakes in it as one complaint.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "common/toml/read_toml.hpp"

namespace ice {

/// The largest case file or specification [bytes], 64 MiB: a speed_table of a million rows fits. A
/// larger bound lets a wrong file fill the memory.
inline constexpr std::uintmax_t kLargestInput = 64u << 20;

/// Text of a whole input file.
/// @param what    "case file", for messages
/// @param ending  usual ending of such files, ".cfg": to find one in a folder
/// @param largest size that is read [bytes]
/// @throws Error (exit code 2) when it is missing, unreadable or larger, or a folder, a mesh, an
///         HDF5 file or UTF-16.
std::string read_input_text(const std::filesystem::path& file, const std::string& what,
                            std::string_view ending, std::uintmax_t largest = kLargestInput);

/// rehearse() for reading a TOML file: keys nested 100 000 deep exhaust toml++'s stack. Nothing
/// happens for a file that is missing or too large, about which reading complains by itself.
void rehearse_input(const std::filesystem::path& file, const std::function<void()>& read);

/// Throws all mistakes as one Error (exit code 2); nothing happens without any.
void throw_mistakes(const Mistakes& mistakes, const std::filesystem::path& file,
                    const std::string& remedy);

}  // namespace ice
