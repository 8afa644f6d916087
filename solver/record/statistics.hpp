// SPDX-License-Identifier: GPL-3.0-or-later
/// The mean of a force history, its uncertainty, and whether the history has a trend.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace ice {

class LongSeries;

/// Chance that a series without a trend is said to have one [-]: the test's level. Larger warns of
/// more trends that are none, smaller misses slow ones.
inline constexpr double kTrendChance = 0.01;

struct MeanInterval {
    double mean = 0.0;               ///< in the series' unit
    double half_width = 0.0;         ///< of the 95 % interval of the mean, in the series' unit
    double correlation_time = 0.0;   ///< sum of the autocorrelation over all lags [samples]
    double effective_samples = 0.0;  ///< independent samples with the same variance of the mean [-]
    double trend = 0.0;  ///< change over the series of the line through it, in the series' unit
    std::optional<bool> trend_significant;  ///< at 99 %; none: too short to tell
};

/// Mean of an autocorrelated series x_1 ... x_n with its 95 % interval.
///
/// The variance of the mean is S / n with S = sum over all lags k of the autocovariance c_k, the
/// spectral density at frequency zero. A sum of estimated c_k is S smoothed over a band of
/// frequencies, so S is taken from that band itself: the mean of the periodogram
///
///     I_j = |sum_t (x_t - mean) exp(-2 pi i j t / n)|^2 / n,   j = 1 ... J,
///
/// each of which is S / 2 times a chi-squared variable with two degrees of freedom where the
/// spectrum is flat from 0 to J / n. Then (mean - true mean) / sqrt(S / n) is Student's with 2 J
/// degrees (orthonormal series: Sun, Econometrics Journal 16, 2013; Lazarus et al., Journal of
/// Business & Economic Statistics 36, 2018). The width of the band follows from the
/// autocorrelation, in three steps:
///
/// 1. Window W (Sokal, Monte Carlo Methods in Statistical Mechanics, 1997, section 3): the first
///    lag with W >= 5 tau(W), tau(W) = 1/2 + sum_{k <= W} c_k / c_0. Then J = n / (6 W), at least
///    2: up to there the spectrum of exp(-k / tau) falls by less than a twentieth.
/// 2. A spectrum that rises from zero on, as that of bodies that meet in turn does, or falls, as
///    that of slow changes under fast hits, has a narrower band: J is halved while the halves'
///    means differ by two standard deviations. Then step 1 once more with means of blocks, 24 per
///    ordinate that is left: these show slow correlation that noise hid.
/// 3. Lines are left out. A period that the series contains many times has next to no effect on the
///    mean, but all its power in one I_j: the largest is dropped while it fails Fisher's test for a
///    hidden period at 1 % (Proceedings of the Royal Society A 125, 1929), four ordinates stay. A
///    period that it contains fewer than five times stays: it may as well be slow noise.
///
/// So negative lobes of the autocorrelation make the interval narrower, which batch means cannot
/// do. For white noise it is the classical one. Series beyond 8192 samples are averaged in blocks
/// for all but the mean.
///
/// The trend is that of the least-squares line. Its variance is 12 S / n, S of the residuals
/// of the line, plus 6 / (pi j)^2 I_j, the share of the periods left out.
///
/// A constant series has half width 0. Fewer than 40 samples, or fewer than 2 W: half width,
/// correlation time and samples are NaN, with none the mean too: unknown, not zero.
MeanInterval mean_interval(std::span<const double> series);
/// The interval of a long series: mean, count and deviation are computed from all single values,
/// the spectrum from the blocks of the series.
MeanInterval mean_interval(const LongSeries& series);

/// Mean of independent values with Student's 95 % interval, in their unit; for fewer than two the
/// interval is NaN, for none the mean too.
MeanInterval student_interval(std::span<const double> values);

/// Standard deviation about the mean, in the series' unit; 0 for fewer than two samples.
double standard_deviation(std::span<const double> series);

}  // namespace ice
