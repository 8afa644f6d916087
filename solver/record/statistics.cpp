// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/record/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/base/uncertainty.hpp"
#include "solver/record/long_series.hpp"
#include "solver/record/periodogram.hpp"

namespace ice {

namespace {

// Samples that an interval needs [-]: fewer do not show their correlation. More gives short runs no
// interval at all.
constexpr std::size_t kFewestSamples = 40;
// Samples that are used one by one [-]; longer series are averaged in blocks. More takes longer;
// fewer hide short correlation.
constexpr std::size_t kMost = 8192;
// Ordinates of a band at least [-]: Student's t with 4 degrees of freedom. With one alone intervals
// would be half as wide again.
constexpr std::size_t kNarrowest = 2;

// White noise has a window of 3 samples, so an ordinate for 18: with more blocks than that, the
// second estimate narrows no band that is flat.
constexpr std::size_t kBlocksPerOrdinate = 24;

double mean_of(std::span<const double> series) {
    return series.empty() ? std::nan("")
                          : std::accumulate(series.begin(), series.end(), 0.0) /
                                static_cast<double>(series.size());
}

// Means of blocks; the rest at the end is left out.
std::vector<double> blocks_of(std::span<const double> series, std::size_t length) {
    std::vector<double> blocks(series.size() / length);
    for (std::size_t b = 0; b < blocks.size(); ++b)
        blocks[b] = mean_of(series.subspan(b * length, length));
    return blocks;
}

double sum_of_squares(std::span<const double> x) {
    return std::inner_product(x.begin(), x.end(), x.begin(), 0.0);
}

void subtract_mean(std::vector<double>& x) {
    const double mean = mean_of(x);
    for (double& value : x) value -= mean;
}

// Takes the least-squares line out of a series with mean 0.
// @return its rise from the first sample's beginning to the last one's end
double subtract_line(std::vector<double>& x) {
    const auto n = static_cast<double>(x.size());
    const double middle = 0.5 * (n - 1.0);
    double sum = 0.0;
    for (std::size_t t = 0; t < x.size(); ++t) sum += (static_cast<double>(t) - middle) * x[t];
    // sum (t - middle)^2 = n (n^2 - 1) / 12 for t = 0 ... n - 1
    const double slope = sum / (n * (n * n - 1.0) / 12.0);
    for (std::size_t t = 0; t < x.size(); ++t) x[t] -= slope * (static_cast<double>(t) - middle);
    return slope * n;
}

// How many ordinates the autocorrelation of a series with mean 0 allows; none where it has not died
// out within half of the series. @pre not all values are 0
std::optional<std::size_t> bandwidth(const std::vector<double>& x) {
    const std::size_t window = correlation_window(x);
    if (x.size() < 2 * window) return std::nullopt;
    // n / (6 W), rounded
    return std::max(kNarrowest, (x.size() + 3 * window) / (6 * window));
}

// The low end of the spectrum of a series with mean 0; none where it is too short for one.
// @pre not all values are 0
// rules 1 to 3 of section 11: the width by the autocorrelation, halved while it is not flat,
// once more on block means, without periodic lines
std::optional<Band> low_band(const std::vector<double>& x) {
    const std::optional<std::size_t> widest = bandwidth(x);
    if (!widest) return std::nullopt;
    const std::vector<double> ordinates = low_periodogram(x, *widest);
    std::size_t count = flat_band(ordinates);
    if (count < *widest) {
        // noise hid slow correlation: the estimate is repeated on means, in which noise is small
        std::vector<double> slow =
            blocks_of(x, std::max<std::size_t>(1, x.size() / (kBlocksPerOrdinate * count)));
        subtract_mean(slow);
        if (sum_of_squares(slow) > 0.0)
            count = std::min(count, bandwidth(slow).value_or(kNarrowest));
    }
    return without_lines(std::span(ordinates).first(count));
}

// Is a rise larger than a line through the residuals has by chance?
std::optional<bool> is_significant(double rise, const std::vector<double>& detrended) {
    if (sum_of_squares(detrended) == 0.0) return rise != 0.0;
    const std::optional<Band> band = low_band(detrended);
    if (!band) return std::nullopt;
    // the slope of a line through noise of spectral density S has the variance 12 S / n^3
    const auto n = static_cast<double>(detrended.size());
    const double degrees = 2.0 * static_cast<double>(band->stay) - 1.0;  // one is the slope's
    return std::abs(rise) > student_quantile(degrees, kTrendChance) *
                                std::sqrt(12.0 * (band->mean + band->line_trend) / n);
}

// A series of `count` samples with this mean and deviation, given as means of blocks.
struct BlockedSeries {
    std::span<const double> blocks;
    double mean, deviation;
    std::size_t count;
};

MeanInterval interval_of(const BlockedSeries& series) {
    const double unknown = std::nan("");
    MeanInterval out{series.mean, unknown, unknown, unknown, unknown, std::nullopt};
    if (series.count < kFewestSamples) return out;
    // Long series are averaged to blocks: low frequencies lose nothing, and the cost is bounded.
    // as many samples to a block as bring their number to kMost
    const std::size_t length = (series.blocks.size() + kMost - 1) / kMost;
    std::vector<double> x = blocks_of(series.blocks, length);
    subtract_mean(x);
    const auto n = static_cast<double>(x.size());
    // A constant force, as without ice, has no scatter and no period.
    if (sum_of_squares(x) == 0.0) {
        out.half_width = out.trend = 0.0;
        return out;
    }
    // Equation (21): the low ordinates of the periodogram estimate S, the variance of the mean is S
    // / n.
    const std::optional<Band> band = low_band(x);
    if (band) {
        // each ordinate is a chi-square variable with two degrees of freedom
        out.half_width = student_quantile(2.0 * static_cast<double>(band->stay), 0.05) *
                         std::sqrt(band->mean / n);
        // S of single samples is that of blocks times their length
        out.effective_samples = n * series.deviation * series.deviation / band->mean;
        out.correlation_time = static_cast<double>(series.count) / out.effective_samples;
    }
    out.trend = subtract_line(x);
    out.trend_significant = is_significant(out.trend, x);
    return out;
}

}  // namespace

double standard_deviation(std::span<const double> series) {
    if (series.size() < 2) return 0.0;
    const double mean = mean_of(series);
    double sum = 0.0;
    for (const double x : series) sum += (x - mean) * (x - mean);
    return std::sqrt(sum / static_cast<double>(series.size() - 1));
}

MeanInterval student_interval(std::span<const double> values) {
    const auto n = static_cast<double>(values.size());
    const double unknown = std::nan("");
    MeanInterval out{mean_of(values), unknown, 1.0, n, unknown, std::nullopt};
    if (values.size() >= 2)
        out.half_width =
            student_quantile(n - 1.0, 0.05) * standard_deviation(values) / std::sqrt(n);
    return out;
}

MeanInterval mean_interval(std::span<const double> series) {
    return interval_of({series, mean_of(series), standard_deviation(series), series.size()});
}

MeanInterval mean_interval(const LongSeries& series) {
    return interval_of(
        {series.blocks(), series.mean(), series.standard_deviation(), series.count()});
}

}  // namespace ice
