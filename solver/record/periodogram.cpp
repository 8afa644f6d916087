// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/record/periodogram.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "common/base/assert.hpp"

namespace ice {

namespace {

// Window in correlation times [-]; 4 to 6 are usual (Sokal). Less cuts correlation off, more adds
// its noise.
constexpr double kWindow = 5.0;
// Chance that a band without a line is said to have one [-]. More drops slow noise as lines, and
// intervals become too narrow; less keeps lines, and they become too wide.
constexpr double kLineChance = 0.01;
// Ordinates that stay in a band at least [-]: fewer do not distinguish a line from noise.
constexpr std::size_t kLeastOrdinates = 4;
// Standard deviations by which the halves of a band may differ [-]: with less, noise halves flat
// bands without need (one in twenty at 2); with more, a sloping spectrum passes for a flat one.
constexpr double kDeviations = 2.0;
// Periods of a line at least [-]: periods that the series contains more seldom move its mean.
constexpr std::size_t kFewestPeriods = 5;

// Fisher's test of the largest of m exponential variables, against the mean of the others: with
// k = m - 1 of them each exceeds x times that mean with the chance (1 + x / k)^-k.
double largest_by_chance(std::size_t m) {
    const auto k = static_cast<double>(m - 1);
    return k * (std::pow(static_cast<double>(m) / kLineChance, 1.0 / k) - 1.0);
}

}  // namespace

std::size_t correlation_window(std::span<const double> x) {
    const auto covariance = [&](std::size_t lag) {
        return std::inner_product(x.begin() + static_cast<std::ptrdiff_t>(lag), x.end(), x.begin(),
                                  0.0);
    };
    const double variance = covariance(0);
    ICE_ASSERT(variance > 0.0);
    // tau(W) = 1/2 + sum of c_k / c_0 up to the first lag W >= 5 tau(W) (section 11, rule 1)
    double time = 0.5;
    for (std::size_t lag = 1; lag < x.size(); ++lag) {
        time += covariance(lag) / variance;
        if (static_cast<double>(lag) >= kWindow * time) return lag;
    }
    return x.size();
}

std::vector<double> low_periodogram(std::span<const double> x, std::size_t count) {
    const std::size_t n = x.size();
    ICE_ASSERT(2 * count < n);
    std::vector<double> cosine(n), sine(n);
    for (std::size_t t = 0; t < n; ++t) {
        const double angle =
            2.0 * std::numbers::pi * static_cast<double>(t) / static_cast<double>(n);
        cosine[t] = std::cos(angle);
        sine[t] = std::sin(angle);
    }
    std::vector<double> out(count);
    for (std::size_t j = 1; j <= count; ++j) {
        double re = 0.0, im = 0.0;
        // Frequency j visits the table of one turn in steps of j: no sine or cosine in the inner
        // loop.
        for (std::size_t t = 0, turn = 0; t < n; ++t, turn = (turn + j) % n) {
            re += x[t] * cosine[turn];
            im += x[t] * sine[turn];
        }
        out[j - 1] = (re * re + im * im) / static_cast<double>(n);
    }
    return out;
}

Band without_lines(std::span<const double> ordinates, std::size_t first) {
    std::vector<std::pair<double, std::size_t>> sorted;  // value, j
    for (std::size_t k = 0; k < ordinates.size(); ++k) sorted.emplace_back(ordinates[k], first + k);
    std::sort(sorted.begin(), sorted.end());
    Band band{0.0, sorted.size(), 0.0};
    for (const auto& [value, j] : sorted) band.mean += value;  // the sum, for now
    while (band.stay > kLeastOrdinates) {
        // Fisher's test, largest first: an ordinate that chance alone would rarely exceed is a
        // periodic line, not noise.
        const auto [largest, j] = sorted[band.stay - 1];
        const double others = (band.mean - largest) / static_cast<double>(band.stay - 1);
        if (j < kFewestPeriods || largest <= largest_by_chance(band.stay) * others) break;
        band.mean -= largest;
        --band.stay;
        const double share = std::numbers::pi * static_cast<double>(j);
        band.line_trend += 6.0 / (share * share) * largest;
    }
    band.mean /= static_cast<double>(band.stay);
    return band;
}

std::size_t flat_band(std::span<const double> ordinates) {
    // rule 2: half the band until both halves have the same mean, within two deviations
    std::size_t count = ordinates.size();
    while (count >= 4) {
        const std::size_t half = count / 2;
        const Band lower = without_lines(ordinates.first(half));
        const Band upper = without_lines(ordinates.subspan(half, count - half), half + 1);
        // the logarithm of a mean of m exponential variables scatters by 1 / sqrt(m)
        const double deviation = std::sqrt(1.0 / static_cast<double>(lower.stay) +
                                           1.0 / static_cast<double>(upper.stay));
        const auto [less, more] = std::minmax(lower.mean, upper.mean);
        if (more <= less * std::exp(kDeviations * deviation)) break;
        count = half;
    }
    return count;
}

}  // namespace ice
