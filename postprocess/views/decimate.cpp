// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/views/decimate.hpp"

#include <algorithm>
#include <cmath>

namespace ice::views {

std::vector<Vec2> decimate(const std::vector<double>& x, const std::vector<double>& y,
                           std::size_t bins) {
    std::vector<Vec2> points;
    for (std::size_t k = 0; k < std::min(x.size(), y.size()); ++k)
        if (std::isfinite(x[k]) && std::isfinite(y[k])) points.emplace_back(x[k], y[k]);
    if (points.size() <= 2 * bins || bins == 0) return points;

    const double low = points.front().x(), extent = points.back().x() - low;
    const auto bin_of = [&](const Vec2& p) {
        if (!(extent > 0.0)) return std::size_t{0};
        const double place = (p.x() - low) / extent * static_cast<double>(bins);
        return std::min(bins - 1, static_cast<std::size_t>(std::max(0.0, place)));
    };
    std::vector<Vec2> kept;
    for (std::size_t begin = 0; begin < points.size();) {
        std::size_t end = begin, lowest = begin, highest = begin;
        for (; end < points.size() && bin_of(points[end]) == bin_of(points[begin]); ++end) {
            if (points[end].y() < points[lowest].y()) lowest = end;
            if (points[end].y() > points[highest].y()) highest = end;
        }
        kept.push_back(points[std::min(lowest, highest)]);
        if (lowest != highest) kept.push_back(points[std::max(lowest, highest)]);
        begin = end;
    }
    return kept;
}

std::vector<Vec2> moving_average(const std::vector<double>& x, const std::vector<double>& y,
                                 double half_width, std::size_t count) {
    std::vector<Vec2> curve;
    if (x.size() < 2 || y.size() != x.size() || count < 2) return curve;
    std::vector<double> sum(y.size() + 1, 0.0);
    for (std::size_t k = 0; k < y.size(); ++k)
        sum[k + 1] = sum[k] + (std::isfinite(y[k]) ? y[k] : 0.0);
    for (std::size_t k = 0; k < count; ++k) {
        const double at = x.front() + (x.back() - x.front()) * static_cast<double>(k) /
                                          static_cast<double>(count - 1);
        const auto first = std::lower_bound(x.begin(), x.end(), at - half_width) - x.begin();
        const auto last = std::upper_bound(x.begin(), x.end(), at + half_width) - x.begin();
        if (last > first)
            curve.emplace_back(
                at, (sum[static_cast<std::size_t>(last)] - sum[static_cast<std::size_t>(first)]) /
                        static_cast<double>(last - first));
    }
    return curve;
}

}  // namespace ice::views
