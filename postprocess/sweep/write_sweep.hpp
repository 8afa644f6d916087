// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "postprocess/sweep/read_sweep.hpp"

namespace ice::sweep {

/// The page of a sweep: resistance against x with intervals and Lindqvist's formula, parts of the
/// resistance in small multiples over the other axes, tables with links to the runs' reports and
/// for download as CSV, buttons that save charts. Runs in 2D and in 3D share nothing
/// (split_sweep()). One file that loads nothing; without its script only the buttons are missing;
/// valid XML.
/// @param page where it will lie: links to the runs are relative to it
std::string make_sweep_page(const Sweep& sweep, const std::filesystem::path& page);

/// The first chart of runs of one dimension as an SVG file's text: resistance against x, a curve
/// for each combination of the other axes' values. "" where there is none: no number varies, or too
/// many combinations.
std::string make_sweep_curve(const Sweep& sweep);

/// Names of the runs without numbers: "2 of 8 runs have no result: a, b"; "" when all completed.
std::string list_faults(const Sweep& sweep);

}  // namespace ice::sweep
