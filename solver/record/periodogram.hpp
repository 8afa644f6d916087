// SPDX-License-Identifier: GPL-3.0-or-later
/// The low end of a series' spectrum and the band in which it is flat; used by statistics.hpp.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace ice {

/// Sokal's window of a series with mean 0: the first lag W >= 5 (1/2 + sum_{k <= W} c_k / c_0)
/// [samples].
/// @return the series' length where no lag satisfies it @pre not all values are 0
std::size_t correlation_window(std::span<const double> x);

/// I_j = |sum_t x_t exp(-2 pi i j t / n)|^2 / n for j = 1 ... count, equation (21), in the square
/// of the series' unit: entry j - 1 is I_j.
/// @pre 2 count < n
std::vector<double> low_periodogram(std::span<const double> x, std::size_t count);

/// A band of the periodogram without its lines.
struct Band {
    double mean = 0.0;        ///< of the ordinates that stay, in the square of the series' unit
    std::size_t stay = 0;     ///< how many
    double line_trend = 0.0;  ///< sum of 6 / (pi j)^2 I_j of the lines taken out
};

/// Drops lines from ordinates first, first + 1, ... of a periodogram by Fisher's test at 1 %; never
/// j < 5, periods that the series contains so seldom that they move its mean. Four ordinates stay.
/// @param first  j of the first ordinate
Band without_lines(std::span<const double> ordinates, std::size_t first = 1);

/// How many of the ordinates, the first ones, form a band that neither rises nor falls: halved
/// while its halves' means differ by more than two standard deviations of their logarithm. Fewer
/// than four are not halved.
std::size_t flat_band(std::span<const double> ordinates);

}  // namespace ice
