// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/ship/thrust.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/interpolate.hpp"

namespace ice {

double bollard_pull(const Propulsion& p) {
    if (!std::isnan(p.bollard_pull)) return p.bollard_pull;
    if (std::isnan(p.power)) return 0.0;
    // T_B = K (P D)^(2/3), K for one, two and three screws
    constexpr double kPerScrews[] = {0.78, 0.98, 1.12};  // [kN / (kW m)^(2/3)]
    const double screws = kPerScrews[std::clamp(p.screws, 1, 3) - 1];
    return 1e3 * screws * std::pow(1e-3 * p.power * p.propeller_diameter, 2.0 / 3.0);
}

double thrust_at(const Propulsion& p, double speed) {
    if (!std::isnan(p.thrust)) return p.thrust;
    if (!p.thrust_table.empty()) return interpolate(p.thrust_table, speed);
    const double pull = bollard_pull(p);
    if (pull == 0.0 || speed < 0.0) return pull;
    // (S2); astern, the bollard pull
    const double share = speed / p.open_water_speed;
    return pull * (1.0 - share / 3.0 - 2.0 / 3.0 * share * share);
}

double open_water_resistance(const Propulsion& p, double speed) {
    const SpeedCurve& table = p.resistance_table;
    const double size = table.empty() ? 0.0 : interpolate(table, std::abs(speed));
    return speed < 0.0 ? -size : size;
}

}  // namespace ice
