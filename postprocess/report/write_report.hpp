// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "postprocess/read/run_folder.hpp"

namespace ice::report {

/// The report of a run as one HTML page below 2 MB: numbers, pictures, histories, case, origin.
///
/// It needs no script and no network. The report of a killed run has no tables of statistics.
std::string make_report(const read::RunFolder& run);

/// Writes make_report() to a file. @throws Error (exit code 1) when it cannot be written.
void write_report(const read::RunFolder& run, const std::filesystem::path& file);

}  // namespace ice::report
