// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "postprocess/report/tables.hpp"
#include "postprocess/sweep/sweep_points.hpp"

namespace ice::sweep {

/// Unit that all charts and tables of a sweep share, by the largest mean resistance; newtons
/// without points.
report::ForceUnit choose_sweep_unit(const std::vector<Point>& points);

/// Resistance against x with intervals, a curve for each combination of the other axes' values,
/// Lindqvist's formula dashed in the same colour. "" without x or points, or with so many curves
/// that they could not be told apart. Over the speed the axis begins at 0 and has knots above.
/// Intervals of two runs only, for which Student's factor is 12.7, are dashed.
/// @param width of the picture [px]
std::string draw_overview(const Sweep& sweep, const std::vector<Curve>& curves,
                          const report::ForceUnit& unit, double width);

/// The largest resistance in one step, of all runs of a point and in the mean over them, beside the
/// mean resistance; "" as above, or where no peak is known. @param width of the picture [px]
std::string draw_peaks(const Sweep& sweep, const std::vector<Curve>& curves, double width);

/// One chart per curve, all on the same axes: resistance with intervals, and the parts that add up
/// to it. In broken ice normal forces on bow, sides, bottom and the rest, friction in all, and the
/// formulas. In level ice breaking and submersion, of the runs and of the formulas, in whose band
/// the totals are. None without x. @param width of each picture [px]
std::vector<std::string> draw_parts(const Sweep& sweep, const std::vector<Curve>& curves,
                                    const report::ForceUnit& unit, double width);

}  // namespace ice::sweep
