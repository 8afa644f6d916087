// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

namespace ice {

struct MeanInterval {
    double mean = 0.0;
    double half_width = 0.0;  ///< of the 95 % interval of the mean
};

/// Mean of an autocorrelated series with its 95 % interval from batch means.
///
/// The series is cut into 20 batches of equal length; batches longer than the correlation time are
/// nearly independent, so the interval is t(0.975, 19) s / sqrt(20) with s the standard deviation
/// of the batch means (Law, Simulation Modeling and Analysis, chapter 9). The remainder after the
/// last whole batch counts for the mean only. With fewer than 40 samples the half width is NaN,
/// with none the mean too: unknown, not zero.
MeanInterval batch_means(std::span<const double> series);

/// Standard deviation about the mean; 0 for fewer than two samples.
double standard_deviation(std::span<const double> series);

}  // namespace ice
