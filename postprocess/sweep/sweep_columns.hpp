// SPDX-License-Identifier: GPL-3.0-or-later
/// Tables of a sweep as columns of text, for pages and for Markdown alike.
#pragma once

#include <string>
#include <vector>

#include "postprocess/report/tables.hpp"
#include "postprocess/sweep/sweep_points.hpp"

namespace ice::sweep {

struct Column {
    std::string title;               ///< with its unit
    std::vector<std::string> cells;  ///< a row for each point
};

/// "1284 \u00b1 83" in the unit, without the interval where there is none. Of two runs the interval
/// is Student's with t = 12.7, which the text says: "1284 \u00b1 830 (n = 2, t = 12.7)".
/// @param estimate [N; 2D: N/m]; @param runs number of runs behind it; 0: not stated
std::string with_interval(const report::ForceUnit& unit, const Estimate& estimate,
                          std::size_t runs = 0);

/// Values of the axes. @param knots after the speed also in knots
std::vector<Column> axis_columns(const Sweep& sweep, const std::vector<Point>& points, bool knots);

/// Resistance with its interval, the parts given, breaking and submersion, largest resistance, the
/// formulas that can be compared with it and the release rule; columns without a number other than
/// 0 are left out but for the first and the last.
/// @param intervals of the parts, too
std::vector<Column> force_columns(const std::vector<Point>& points, const report::ForceUnit& unit,
                                  std::vector<std::pair<Part, std::string>> parts, bool intervals);

/// Cracks and channel of points in level ice, beside the published ranges; none where no point has
/// them.
std::vector<Column> crack_columns(const std::vector<Point>& points);

/// Uses of the ship's work, per metre of travel (share_work.hpp) [N; 2D: N/m] in the unit, without
/// empty columns. @pre there are points
std::vector<Column> work_columns(const Sweep& sweep, const std::vector<Point>& points,
                                 const report::ForceUnit& unit);

}  // namespace ice::sweep
