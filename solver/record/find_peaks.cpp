// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/record/find_peaks.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "solver/record/long_series.hpp"

namespace ice {

namespace {

// Levels of exceedance [-]: all of the 10 highest peaks, then every 1.25th rank. On the logarithmic
// axis of rates the points lie evenly; more of them only lengthen the summary.
constexpr std::size_t kDenseRanks = 10;
constexpr double kRankFactor = 1.25;
constexpr double kHour = 3600.0;  // [s]

std::vector<double> peaks_above(std::span<const double> series, double level) {
    std::vector<double> peaks;
    // between two up-crossings of the level the largest value counts once
    bool above = true;  // a series that begins above the level has no up-crossing there
    bool counts = false;
    for (const double value : series) {
        if (value > level && !above) {
            peaks.push_back(value);
            counts = true;
        }
        above = value > level;
        if (counts) peaks.back() = std::max(peaks.back(), value);
    }
    return peaks;
}

// NaN without windows; peaks_of() does not use it then.
double mean_of_windows(std::span<const double> series) {
    return std::accumulate(series.begin(), series.end(), 0.0) / static_cast<double>(series.size());
}

// @param window  time per value of the series [s], whose mean is `mean`
PeakStatistics peaks_of(std::span<const double> series, double mean, double window) {
    PeakStatistics out;
    if (series.empty()) return out;
    const auto count = static_cast<double>(series.size());
    out.mean = mean;
    out.max = *std::max_element(series.begin(), series.end());
    out.p99 = quantile({series.begin(), series.end()}, 0.99);
    std::vector<double> peaks = peaks_above(series, out.mean);
    std::sort(peaks.begin(), peaks.end(), std::greater<>());
    out.count = static_cast<std::int64_t>(peaks.size());
    const double hours = count * window / kHour;
    // exceedance: the peak of this rank is reached so often per hour
    for (std::size_t rank = 1; rank <= peaks.size();) {
        out.exceeded.push_back({peaks[rank - 1], static_cast<double>(rank) / hours});
        if (rank == peaks.size()) break;
        const auto next = static_cast<std::size_t>(kRankFactor * static_cast<double>(rank));
        rank = std::min(peaks.size(), rank < kDenseRanks ? rank + 1 : next);
    }
    return out;
}

}  // namespace

double quantile(std::vector<double> series, double share) {
    if (series.empty()) return 0.0;
    // the smallest value that at least this share of the values does not exceed
    // By selection, not by sorting: one quantile of a long series is wanted.
    const auto rank = static_cast<std::size_t>(
        std::max(0.0, std::ceil(share * static_cast<double>(series.size())) - 1.0));
    const auto place = series.begin() + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(series.begin(), place, series.end());
    return *place;
}

PeakStatistics find_peaks(std::span<const double> series, double window) {
    return peaks_of(series, mean_of_windows(series), window);
}

PeakStatistics find_peaks(const LongSeries& series, double window) {
    PeakStatistics out = peaks_of(series.blocks(), series.mean(),
                                  window * static_cast<double>(series.block_length()));
    out.max = series.largest();  // the unfinished block is in none of the others
    return out;
}

}  // namespace ice
