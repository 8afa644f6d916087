// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "common/base/assert.hpp"

namespace ice {

/// Value of a table of (x, y) at x, in the unit of y: linear between rows, constant outside. The
/// unit of x is the table's. Rows with equal x are a step, whose first value counts at x itself.
/// @pre the table is not empty and its x rise
inline double interpolate(const std::vector<std::pair<double, double>>& table, double x) {
    ICE_ASSERT(!table.empty());
    ICE_ASSERT(std::is_sorted(table.begin(), table.end(),
                              [](const auto& l, const auto& r) { return l.first < r.first; }));
    if (x <= table.front().first) return table.front().second;
    if (x > table.back().first) return table.back().second;
    const auto after = std::lower_bound(table.begin(), table.end(), x,
                                        [](const auto& row, double v) { return row.first < v; });
    const auto& [x0, y0] = *(after - 1);
    const auto& [x1, y1] = *after;
    return y0 + (y1 - y0) * (x - x0) / (x1 - x0);
}

}  // namespace ice
