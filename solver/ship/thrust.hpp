// SPDX-License-Identifier: GPL-3.0-or-later
/// Thrust and open-water resistance of a ship (docs/method.md, section 13).
#pragma once

#include "solver/case/ship_keys.hpp"

namespace ice {

/// Thrust at rest [N]: bollard_pull, which wins over power, or from power P_D [W] and propeller
/// diameter D [m]
///
///     T_B = K_e (P_D D)^(2/3),   T_B in kN, P_D in kW,
///
/// K_e = 0.78, 0.98, 1.12 for one, two, three screws [kN / (kW m)^(2/3)] (the ice class rules'
/// bollard pull); 0 where neither is given. The numbers were read in one open code; another text
/// has 0.728 for one screw, and no rule book was at hand: give bollard_pull where it is known.
double bollard_pull(const Propulsion& propulsion);

/// Thrust [N] at speed U through the water [m/s], positive forward; without speed hold. Net thrust
/// is
///
///     T = T_B (1 - U / (3 U_ow) - 2/3 (U / U_ow)^2)  for U >= 0,   T_B for U < 0,
///
/// (equation (S2)) 0 at the open-water speed U_ow, because the open-water resistance is taken off
/// already, and below 0 beyond it. propulsion.thrust wins over a table, a table over net thrust.
double thrust_at(const Propulsion& propulsion, double speed);

/// Resistance in open water [N] at speed U [m/s]: resistance_table, odd in U; 0 without a table.
double open_water_resistance(const Propulsion& propulsion, double speed);

}  // namespace ice
