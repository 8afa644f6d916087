// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/ship/delivered_power.hpp"

#include <cmath>
#include <limits>

#include "solver/ship/thrust.hpp"

namespace ice {

double delivered_power(const Propulsion& p, double thrust, double speed) {
    if (!std::isnan(p.power)) return p.power;
    if (std::isnan(p.propeller_diameter) || std::isnan(p.open_water_speed))
        return std::numeric_limits<double>::quiet_NaN();
    if (thrust <= 0.0) return 0.0;
    // thrust_at() rounds to a little more than 0 there
    if (speed >= p.open_water_speed) return std::numeric_limits<double>::infinity();
    // (S2) inverted: the thrust of 1 W at this speed, and the power of the thrust's 3/2
    Propulsion watt;  // thrust is proportional to power^(2/3)
    watt.power = 1.0;
    watt.propeller_diameter = p.propeller_diameter;
    watt.screws = p.screws;
    watt.open_water_speed = p.open_water_speed;
    return std::pow(thrust / thrust_at(watt, speed), 1.5);
}

}  // namespace ice
