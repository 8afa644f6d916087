// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

namespace ice::statistics {

/// Series over one common time.
struct ThinSeries {
    std::vector<double> time;                 ///< [s], rising
    std::vector<std::vector<double>> values;  ///< [series x times], units of the series
};

/// Thins several series at once for drawing and keeps every peak of each.
///
/// Samples are cut into `bins` groups of equal number. Each group leaves two times, its first and
/// its last, and of each series its lowest and highest value there in the order they had: a peak
/// may move within its group. Up to 2 * bins samples come back as they are.
/// @param time [s], rising; @param series lists as long as `time`; @param bins a count; 0 thins
/// nothing
ThinSeries thin_series(const std::vector<double>& time,
                       const std::vector<std::vector<double>>& series, std::size_t bins);

/// Smoothed values of y at the given places: means weighted with Hann's window
///
///     w(t) = (1 + cos(pi (t - place) / width)) / 2   for |t - place| < width, else 0,
///
/// which is `width` wide at half its height, cut at the ends of x. Its slope is continuous: a hit
/// of one sample becomes a bell, not a box. Values that are not finite count as 0; where no x is
/// within reach the result is 0. @param x rising; @param y as many values; @param width > 0 and
/// @param places in the unit of x; results in the unit of y
std::vector<double> moving_average(const std::vector<double>& x, const std::vector<double>& y,
                                   double width, const std::vector<double>& places);

}  // namespace ice::statistics
