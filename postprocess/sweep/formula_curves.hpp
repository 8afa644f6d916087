// SPDX-License-Identifier: GPL-3.0-or-later
/// The formulas that are drawn beside the points of a sweep.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/formulas/formula_band.hpp"
#include "postprocess/sweep/sweep_points.hpp"

namespace ice::sweep {

/// A part of a formula, drawn over the points.
struct FormulaCurve {
    std::string name, part;  ///< FormulaValue
    std::string legend;      ///< the author without the year, or the user's ship
    std::string dash;        ///< SVG dash pattern
};

/// Formulas that can be compared with the points' resistance (comparable_formulas()), in the
/// formulas' order; none without points.
std::vector<FormulaCurve> comparable_curves(const std::vector<Curve>& curves);

/// Components below these: buoyancy, and in level ice the resistance of broken ice.
/// @pre the curve has a point
std::vector<FormulaCurve> component_curves(const Curve& curve);

/// The band of the comparable formulas at a point [N; 2D: N/m]; none without any.
std::optional<FormulaBand> formula_band(const Point& point);

/// "Lindqvist" for "Lindqvist 1989"; a name without a year as it is.
std::string author_of(const std::string& name);

/// All parts that any of the points has, in the formulas' order.
std::vector<FormulaValue> formula_columns(const std::vector<Point>& points);

}  // namespace ice::sweep
