// SPDX-License-Identifier: GPL-3.0-or-later
/// A TOML input as a whole: its text, and all mistakes in it as one complaint.
#pragma once

#include <filesystem>
#include <string>

#include "common/toml/read_toml.hpp"

namespace ice {

/// Text of a whole input file.
/// @param what  "case file", for messages
/// @throws Error (exit code 2) when it is missing, unreadable or larger than 64 MB.
std::string read_input_text(const std::filesystem::path& file, const std::string& what);

/// Throws all mistakes as one Error (exit code 2); nothing happens without any.
void throw_mistakes(const Mistakes& mistakes, const std::filesystem::path& file,
                    const std::string& remedy);

}  // namespace ice
