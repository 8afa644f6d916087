// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "postprocess/read/read_run_folder.hpp"

namespace ice::report {

/// Histories of the ship and the tracked floes' paths as one SVG for papers and slides: forces with
/// their moving averages, coverage of the bottom, paths as the ship sees them from above and from
/// starboard, and the forces of each tracked floe that touched the ship.
/// @throws Error (exit code 2) for a run without histories
std::string draw_plot(const read::RunFolder& run);

}  // namespace ice::report
