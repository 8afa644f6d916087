// SPDX-License-Identifier: GPL-3.0-or-later
/// A run's result as lines for a terminal: as many digits as the interval is worth.
#pragma once

#include <string>

#include "common/formats/summary_file.hpp"

namespace ice {

/// "1410 +- 55 N": the interval with two significant digits, the value to its last one; kN from
/// 10 kN on, per metre in 2D. Without an interval (NaN) four digits, and why.
/// @param value, half_width  [N], in 2D [N/m]
std::string force_text(double value, double half_width, int dimension);
/// "1.42 kN": three digits, of a whole ship. @param value  [N]
std::string force_text(double value);

/// Mean resistance with interval, at the mean speed of the averaged time, and its parts.
std::string resistance_line(const Summary& summary);

/// The empirical formulas that compare with the mean: of level ice the band of their totals, of
/// broken ice Lindqvist's submersion resistance; "" where the summary has none.
std::string formulas_line(const Summary& summary);

/// The ship's work and its uses of at least 1 %, largest share first; "" when it did none.
/// All shares are in summary.json.
std::string energy_line(const Summary& summary);

/// Student's interval of an ensemble and its members' means. @pre the summary has an ensemble
std::string ensemble_line(const Summary& summary);

}  // namespace ice
