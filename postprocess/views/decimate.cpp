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
    // two points per bin are the most that is kept: shorter series stay whole
    if (points.size() <= 2 * bins || bins == 0) return points;

    const double low = points.front().x(), extent = points.back().x() - low;
    const auto bin_of = [&](const Vec2& p) {
        if (!(extent > 0.0)) return std::size_t{0};
        const double place = (p.x() - low) / extent * static_cast<double>(bins);
        return std::min(bins - 1, static_cast<std::size_t>(std::max(0.0, place)));
    };
    // Means of bins would be shorter to compute, but hide each hit of the ice.
    std::vector<Vec2> kept;
    for (std::size_t begin = 0; begin < points.size();) {
        // lowest and highest of each bin, in their order in time: peaks stay to the full height
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

}  // namespace ice::views
