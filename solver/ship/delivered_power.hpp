// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/case/ship_keys.hpp"

namespace ice {

/// Power [W] delivered to the propellers that gives this net thrust [N] at speed U through the
/// water [m/s]: propulsion.power where it is given; else, from propeller_diameter D and
/// open_water_speed, the inverse of thrust_at(),
///
///     P_D = (T / (K_e (1 - U / (3 U_ow) - 2/3 (U / U_ow)^2)))^(3/2) / D,
///
/// (equation (S2) inverted, K_e as in thrust.hpp) without the speed's terms for U < 0; 0 for no
/// thrust or one astern, infinite from U_ow on. NaN where the keys are not given.
double delivered_power(const Propulsion& propulsion, double thrust, double speed);

}  // namespace ice
