// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/ship/thrust.hpp"

#include <algorithm>
#include <cmath>

namespace ice {

double value_at(const SpeedCurve& curve, double speed) {
    if (curve.empty()) return 0.0;
    if (speed <= curve.front().first) return curve.front().second;
    if (speed > curve.back().first) return curve.back().second;
    // linear between two rows, constant before the first and after the last
    const auto after = std::lower_bound(curve.begin(), curve.end(), speed,
                                        [](const auto& row, double u) { return row.first < u; });
    const auto& [u0, f0] = *(after - 1);
    const auto& [u1, f1] = *after;
    return f0 + (f1 - f0) * (speed - u0) / (u1 - u0);
}

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
    if (!p.thrust_table.empty()) return value_at(p.thrust_table, speed);
    const double pull = bollard_pull(p);
    if (pull == 0.0 || speed < 0.0) return pull;
    // (S2); astern, the bollard pull
    const double share = speed / p.open_water_speed;
    return pull * (1.0 - share / 3.0 - 2.0 / 3.0 * share * share);
}

double open_water_resistance(const Propulsion& p, double speed) {
    const double size = value_at(p.resistance_table, std::abs(speed));
    return speed < 0.0 ? -size : size;
}

}  // namespace ice
