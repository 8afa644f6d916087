// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "postprocess/read/read_run_folder.hpp"

namespace ice::report {

/// Unit in which a group of forces reads best.
struct ForceUnit {
    std::string name;      ///< "N", "kN", "MN"; in 2D "N/m", ...
    double newtons = 1.0;  ///< one unit [N]; in 2D [N/m]
    int decimals = 0;      ///< digits behind the point, so that the largest has 4
    /// A force [N] in this unit, without the unit's name; "n/a" where it is not finite.
    std::string text(double force) const;
};

/// The unit of all forces of a page: that in which the mean resistance reads best, with the
/// decimals that its interval is worth (two digits of it). Of a run without summary that of the
/// mean over the second half of the record, with 4 digits.
ForceUnit page_unit(const read::RunFolder& run);

/// The unit of force times metre. In 2D moments are per metre of breadth, too.
ForceUnit moment_unit(const ForceUnit& force);

/// @param largest magnitude the unit is chosen for [N]; NaN counts as 0
/// @param dimension 2 gives units per metre, else whole forces
ForceUnit choose_unit(double largest, int dimension);

/// Unit in which loads per area read best.
struct PressureUnit {
    std::string name;      ///< "Pa", "kPa", "MPa"
    double pascals = 1.0;  ///< one unit [Pa]
};
/// @param largest magnitude [Pa]; NaN counts as 0
PressureUnit choose_pressure_unit(double largest);

/// Mean with the half width of its interval, "1107 \u00b1 12".
std::string mean_and_interval(const ForceUnit& unit, const ForceStatistics& force);

/// Values of empirical formulas for the same ship and ice [N]; older summaries have Lindqvist's
/// alone.
std::vector<FormulaValue> formulas_of(const Summary& summary);

/// Breaking and submersion of a run with floes held until they bend, which add up to its
/// resistance [N]; none of other runs.
std::vector<std::pair<std::string, double>> parts_of(const Summary& summary);

/// Mean with its interval, parts, scatter and maximum of the three components, formulas, and
/// whether the resistance is steady.
std::string force_table(const Summary& summary, const ForceUnit& unit);
/// One row per region of the hull; "" when there are none.
std::string region_table(const Summary& summary, const ForceUnit& unit);
/// The uses of the ship's work, in joules and as shares of it; "" for a run without an energy
/// ledger.
std::string energy_table(const Summary& summary);
/// The balance of the rows of energy_table(), in a sentence: the entries that put energy in are
/// together as large as all entries below them. Entries that the run does not have are left out.
std::string energy_balance(const Summary& summary);
/// Contacts, overlap, computing time: whether the numbers can be trusted.
std::string numerics_table(const Summary& summary);
/// The warnings with their verdicts as a list; "" when there are none.
std::string warning_list(const std::vector<Warning>& warnings);

}  // namespace ice::report
