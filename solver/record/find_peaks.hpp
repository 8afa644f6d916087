// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "common/formats/load_statistics.hpp"

namespace ice {

class LongSeries;

/// Mean, 99th percentile, maximum and peaks of a series of window means, in the series' unit; zeros
/// for an empty one.
///
/// Peaks: the series is cut where it rises from at most its mean to above it; the largest value of
/// each piece that begins so is a peak, that of an unfinished last piece too. So one push that
/// trembles counts once. A series that never rises above its mean, or is empty, has no peaks.
/// Levels are those of the peaks at ranks 1, 2, 3, ... and then ever farther apart, with the last.
/// @param window time per value [s]
PeakStatistics find_peaks(std::span<const double> series, double window);
/// The peaks of a long series, of whose windows the largest in each block are kept: peaks less than
/// two blocks apart may be one, and the percentile is that of the blocks. Mean and maximum are
/// exact. @param window  time per single value [s]
PeakStatistics find_peaks(const LongSeries& series, double window);

/// Value below which `share` [-] of the series lies: the largest for a share of 1, 0 for no series.
double quantile(std::vector<double> series, double share);

}  // namespace ice
