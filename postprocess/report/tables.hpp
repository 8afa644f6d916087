// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "postprocess/read/run_folder.hpp"

namespace ice::report {

/// Unit in which a group of forces reads best.
struct ForceUnit {
    std::string name;                      ///< "N", "kN", "MN"; in 2D "N/m", ...
    double newtons = 1.0;                  ///< one unit in newtons
    int decimals = 0;                      ///< that give the largest number 4 digits
    std::string text(double force) const;  ///< number in this unit, without the unit's name
};

/// @param largest magnitude the unit is chosen for [N]; NaN counts as 0
ForceUnit choose_unit(double largest, int dimension);

/// Unit in which loads per area read best.
struct PressureUnit {
    std::string name;      ///< "Pa", "kPa", "MPa"
    double pascals = 1.0;  ///< one unit in pascals
};
PressureUnit choose_pressure_unit(double largest);

/// The key numbers as cards: resistance, Lindqvist, speed-up, floes.
std::string key_numbers(const Summary& summary);
/// Mean with its interval, parts, scatter and maximum of the three components, and Lindqvist.
std::string force_table(const Summary& summary);
/// One row per region of the hull; "" when there are none.
std::string region_table(const Summary& summary);
/// Where the ship's work went, in joules and as shares of it; "" for a run without a ledger.
std::string energy_table(const Summary& summary);
/// Contacts, overlap, computing time: whether the numbers can be trusted.
std::string numerics_table(const Summary& summary);
/// The warnings with their verdicts as a list; "" when there are none.
std::string warning_list(const std::vector<Warning>& warnings);

}  // namespace ice::report
