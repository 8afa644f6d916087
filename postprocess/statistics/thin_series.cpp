// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/statistics/thin_series.hpp"

#include <algorithm>
#include <cmath>

namespace ice::statistics {

ThinSeries thin_series(const std::vector<double>& time,
                       const std::vector<std::vector<double>>& series, std::size_t bins) {
    const std::size_t count = time.size();
    if (count <= 2 * bins || bins == 0) return {time, series};
    ThinSeries out;
    out.values.resize(series.size());
    for (std::size_t bin = 0; bin < bins; ++bin) {
        const std::size_t begin = bin * count / bins, end = (bin + 1) * count / bins;
        out.time.push_back(time[begin]);
        out.time.push_back(time[end - 1]);
        for (std::size_t s = 0; s < series.size(); ++s) {
            const auto first = series[s].begin() + static_cast<std::ptrdiff_t>(begin);
            const auto last = series[s].begin() + static_cast<std::ptrdiff_t>(end);
            const auto [low, high] = std::minmax_element(first, last);
            out.values[s].push_back(low < high ? *low : *high);
            out.values[s].push_back(low < high ? *high : *low);
        }
    }
    return out;
}

std::vector<double> moving_average(const std::vector<double>& x, const std::vector<double>& y,
                                   double width, const std::vector<double>& places) {
    std::vector<double> sum(y.size() + 1, 0.0);
    for (std::size_t k = 0; k < y.size(); ++k)
        sum[k + 1] = sum[k] + (std::isfinite(y[k]) ? y[k] : 0.0);
    std::vector<double> out;
    for (const double at : places) {
        // half a millionth of slack: times are multiples of a step up to rounding
        const double half = 0.5 * width * (1.0 + 1e-6);
        const auto first = std::lower_bound(x.begin(), x.end(), at - half) - x.begin();
        const auto last = std::upper_bound(x.begin(), x.end(), at + half) - x.begin();
        out.push_back(last > first ? (sum[static_cast<std::size_t>(last)] -
                                      sum[static_cast<std::size_t>(first)]) /
                                         static_cast<double>(last - first)
                                   : 0.0);
    }
    return out;
}

}  // namespace ice::statistics
