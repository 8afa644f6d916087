// SPDX-License-Identifier: GPL-3.0-or-later
// The prescribed course: speed and path of the ship by its table.
#include <algorithm>

#include "common/base/interpolate.hpp"
#include "solver/case/case.hpp"

namespace ice {

bool Case::has_bending() const {
    return has_level_ice() || std::any_of(floes.begin(), floes.end(), [](const FloeGroup& g) {
               return g.hold == Hold::until_bent;
           });
}

double Case::ship_speed(double time) const { return interpolate(speed_table, time); }

// Trapezoids between the rows of the table: exact, since the speed is linear there.
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
