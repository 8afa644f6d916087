// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "postprocess/report/tables.hpp"
#include "postprocess/sweep/sweep_points.hpp"

namespace ice::sweep {

/// Unit that all charts and tables of a sweep share.
report::ForceUnit choose_sweep_unit(const std::vector<Point>& points);

/// Resistance against x with intervals, a curve for each combination of the other axes' values,
/// Lindqvist's formula dashed in the same colour. "" without x or points, or with so many curves
/// that they could not be told apart.
std::string draw_overview(const Sweep& sweep, const std::vector<Curve>& curves,
                          const report::ForceUnit& unit);

/// One chart per curve, all on the same axes: resistance with intervals, normal forces on bow,
/// sides, bottom and the rest, and friction in all, which add up to it, Lindqvist's formula.
std::vector<std::string> draw_parts(const Sweep& sweep, const std::vector<Curve>& curves,
                                    const report::ForceUnit& unit);

}  // namespace ice::sweep
