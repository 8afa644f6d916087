// SPDX-License-Identifier: GPL-3.0-or-later
/// Thrust against speed, net of the resistance of open water.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace ice::attain {

/// A curve of net thrust.
struct Thrust {
    std::string name;               ///< of the curve, in legends
    double bollard_pull = 0.0;      ///< T_B [N]; the constant thrust where open_water_speed is 0
    double open_water_speed = 0.0;  ///< U_ow [m/s]; 0: the thrust is constant
    std::vector<std::pair<double, double>> table;  ///< (U [m/s], T [N]), U rising; before all else

    /// Net thrust [N] at a speed U >= 0: of the table linearly, beyond its ends their values; else
    ///
    ///     T = T_B (1 - U / (3 U_ow) - 2/3 (U / U_ow)^2)
    ///
    /// which is T_B at the bollard and 0 at the open-water speed (Juva and Riska, 2002; recalled).
    double at(double speed) const;

    /// A speed that the ship does not exceed [m/s]; infinite for a constant thrust.
    double fastest() const;
};

/// Bollard pull [N] from power and propellers:
///
///     T_B = K_e (P_D D)^(2/3),   kN, kW and m;   K_e = 0.78, 0.98, 1.12 for 1, 2, 3 propellers
///
/// The numbers K_e [kN / (kW m)^(2/3)] were read in one open program (solver/ship/thrust.hpp); one
/// publication prints 0.728 for a single screw.
/// @param power  delivered, of all propellers [W]; @param diameter  of one propeller [m]
/// @pre 1 to 3 propellers; another number ends the program with an assertion
double bollard_pull(double power, double diameter, int propellers);

/// Reads thrust curves:
///
///     [[thrust]]
///     name = "both engines"              # default: "thrust 1", ...
///     bollard_pull = 1.2e6               # N, with open_water_speed
///     open_water_speed = "16 kn"
///
/// or constant = N, or power = W, propeller_diameter = m, propellers = 2 with open_water_speed, or
/// table = [[U, N], ...], U in m/s and rising. Exactly one of these kinds per [[thrust]].
/// @throws Error (exit code 2) with all mistakes: file, line, key
std::vector<Thrust> read_thrusts(const std::filesystem::path& file);

}  // namespace ice::attain
