// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/record/statistics.hpp"

#include <cmath>
#include <numeric>
#include <vector>

namespace ice {

namespace {

constexpr std::size_t kBatches = 20;
constexpr double kStudent = 2.093;  // t(0.975, 19)

double mean_of(std::span<const double> series) {
    return series.empty() ? std::nan("")
                          : std::accumulate(series.begin(), series.end(), 0.0) /
                                static_cast<double>(series.size());
}

}  // namespace

double standard_deviation(std::span<const double> series) {
    if (series.size() < 2) return 0.0;
    const double mean = mean_of(series);
    double sum = 0.0;
    for (const double x : series) sum += (x - mean) * (x - mean);
    return std::sqrt(sum / static_cast<double>(series.size() - 1));
}

MeanInterval batch_means(std::span<const double> series) {
    MeanInterval out{mean_of(series), std::nan("")};
    const std::size_t length = series.size() / kBatches;
    if (length < 2) return out;
    std::vector<double> means(kBatches);
    for (std::size_t b = 0; b < kBatches; ++b)
        means[b] = mean_of(series.subspan(b * length, length));
    out.half_width =
        kStudent * standard_deviation(means) / std::sqrt(static_cast<double>(kBatches));
    return out;
}

}  // namespace ice
