// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "common/formats/run_file.hpp"

namespace ice::statistics {

/// How much of the hull's bottom is hidden by ice when seen from below, frame by frame.
struct BottomCoverage {
    std::vector<double> time;   ///< [s]
    std::vector<double> share;  ///< of `area` [-], 0 to 1; as many values
    double area = 0.0;          ///< of the wetted hull seen from below [m2] (2D: of its mesh)
};

/// Rasters the hull below the waterline from below and, for each frame, the floes under it: a cell
/// is covered when some ice lies below the hull there. Ice beside a flared hull that does not reach
/// under it does not count.
///
/// @param frames at most so many are measured, evenly chosen, the last one among them; below 2
///        counts as 2
/// A run without hull or frames gives an empty list.
BottomCoverage measure_bottom_coverage(const RunData& run, std::size_t frames);

}  // namespace ice::statistics
