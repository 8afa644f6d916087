// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/statistics/thin_series.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ice::statistics {

ThinSeries thin_series(const std::vector<double>& time,
                       const std::vector<std::vector<double>>& series, std::size_t bins) {
    const std::size_t count = time.size();
    if (count <= 2 * bins || bins == 0) return {time, series};
    ThinSeries out;
    out.values.resize(series.size());
    for (std::size_t bin = 0; bin < bins; ++bin) {
        // bins of equal numbers of rows, not of equal times: output rows are evenly spaced
        const std::size_t begin = bin * count / bins, end = (bin + 1) * count / bins;
        out.time.push_back(time[begin]);
        out.time.push_back(time[end - 1]);
        for (std::size_t s = 0; s < series.size(); ++s) {
            const auto first = series[s].begin() + static_cast<std::ptrdiff_t>(begin);
            const auto last = series[s].begin() + static_cast<std::ptrdiff_t>(end);
            const auto [low, high] = std::minmax_element(first, last);
            // Lowest and highest in their order in time: lines between bins then rise and fall as
            // the series does. All series share the bin's two times, so these are exact to a bin.
            out.values[s].push_back(low < high ? *low : *high);
            out.values[s].push_back(low < high ? *high : *low);
        }
    }
    return out;
}

namespace {

// Sums of w, w cos(k x), w sin(k x) over the first n samples, for every n: the window's sums at any
// place are differences of these, by cos(k (x - p)) = cos(k x) cos(k p) + sin(k x) sin(k p).
struct WindowSums {
    std::vector<double> plain{0.0}, cosine{0.0}, sine{0.0};

    void add(double weight, double c, double s) {
        plain.push_back(plain.back() + weight);
        cosine.push_back(cosine.back() + weight * c);
        sine.push_back(sine.back() + weight * s);
    }
    double over(std::size_t first, std::size_t last, double c, double s) const {
        return plain[last] - plain[first] + c * (cosine[last] - cosine[first]) +
               s * (sine[last] - sine[first]);
    }
};

}  // namespace

std::vector<double> moving_average(const std::vector<double>& x, const std::vector<double>& y,
                                   double width, const std::vector<double>& places) {
    // Hann's window 1 + cos(k (x - p)) within `width` of p: half as high at half the width. Prefix
    // sums make the cost independent of the width.
    const double k = std::numbers::pi / width;
    WindowSums ones, values;
    for (std::size_t n = 0; n < y.size(); ++n) {
        const double c = std::cos(k * x[n]), s = std::sin(k * x[n]);
        ones.add(1.0, c, s);
        values.add(std::isfinite(y[n]) ? y[n] : 0.0, c, s);
    }
    std::vector<double> out;
    for (const double at : places) {
        const auto first =
            static_cast<std::size_t>(std::lower_bound(x.begin(), x.end(), at - width) - x.begin());
        const auto last =
            static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), at + width) - x.begin());
        const double c = std::cos(k * at), s = std::sin(k * at);
        const double weight = ones.over(first, last, c, s);
        // Weights are between 0 and 2. A window with samples at its very ends alone has nothing but
        // rounding.
        out.push_back(weight > 1e-6 ? values.over(first, last, c, s) / weight : 0.0);
    }
    return out;
}

}  // namespace ice::statistics
