// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "solver/case/case.hpp"

namespace ice {

double Case::ship_speed(double time) const {
    if (time <= speed_table.front().first) return speed_table.front().second;
    if (time > speed_table.back().first) return speed_table.back().second;
    const auto after = std::lower_bound(speed_table.begin(), speed_table.end(), time,
                                        [](const auto& row, double t) { return row.first < t; });
    const auto& [t0, u0] = *(after - 1);
    const auto& [t1, u1] = *after;
    return u0 + (u1 - u0) * (time - t0) / (t1 - t0);
}

double Case::ship_travel(double from, double to) const {
    double sum = 0.0, before = from;
    const auto go_to = [&](double time) {  // the speed is linear up to there
        sum += 0.5 * (time - before) * (ship_speed(before) + ship_speed(time));
        before = time;
    };
    for (const auto& row : speed_table)
        if (row.first > before && row.first < to) go_to(row.first);
    go_to(to);
    return sum;
}

}  // namespace ice
