// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace ice {

/// Runs another of the project's programs, the one that lies beside this one's file, and waits.
///
/// The programs know each other by their command lines only: the work of one for another goes
/// the way that its user would go, and a fault in one does not end the other.
/// @param name e.g. "icepost"; @param words of the command line behind it
/// @return its exit code, 128 + the signal that ended it; nothing when there is no such program
std::optional<int> run_sibling(const std::string& name, const std::vector<std::string>& words);

/// Whether that program lies there.
bool has_sibling(const std::string& name);

/// Runs a program, given by its path or found on the PATH, and waits. Interrupts that this program
/// catches meanwhile are passed on (console.hpp), so that none is left behind.
/// @return its exit code, 128 + the signal that ended it; nothing when it cannot be started
std::optional<int> run_child(const std::string& program, const std::vector<std::string>& words);

}  // namespace ice
