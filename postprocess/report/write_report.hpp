// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "postprocess/read/read_run_folder.hpp"

namespace ice::report {

/// Frames of the 3D playback [-], at most: with 200 floes the page stays below 2 MB. More frames
/// play more smoothly, and the page grows in proportion.
constexpr std::size_t kReportFrames = 400;

/// The report of a run as one HTML page: 3D playback, histories, numbers, load map, pictures, case,
/// origin.
///
/// It needs no network, and without script or WebGL it keeps tables and drawings. The report of a
/// killed run has no tables of statistics.
/// @param frames of the playback at most, evenly chosen; below 2 counts as 2
std::string make_report(const read::RunFolder& run, std::size_t frames = kReportFrames);

/// Writes make_report() to a file. @throws Error (exit code 1) when it cannot be written.
void write_report(const read::RunFolder& run, const std::filesystem::path& file,
                  std::size_t frames = kReportFrames);

}  // namespace ice::report
