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
    std::string plus = {};   ///< a second part of the formula that is added; "" none
};

/// Formulas that can be compared with the points' resistance (comparable_formulas()), in the
/// formulas' order; none without points.
std::vector<FormulaCurve> comparable_curves(const std::vector<Curve>& curves);

/// Components below these: buoyancy; in level ice those of breaking (Lindqvist's crushing and
/// bending as one, Jeong's breaking).
/// @pre the curve has a point
std::vector<FormulaCurve> component_curves(const Curve& curve);

/// In level ice the components of ice that is broken already: Lindqvist's submersion, Jeong's
/// buoyancy and clearing; none otherwise. @pre the curve has a point
std::vector<FormulaCurve> broken_curves(const Curve& curve);

/// Value of a drawn part at a point [N], or NaN.
double value_at(const Point& point, const FormulaCurve& drawn);

/// The band of the comparable formulas at a point [N; 2D: N/m]; none without any.
std::optional<FormulaBand> formula_band(const Point& point);

/// "Lindqvist" for "Lindqvist 1989"; a name without a year as it is.
std::string author_of(const std::string& name);

/// All parts that any of the points has, in the formulas' order.
std::vector<FormulaValue> formula_columns(const std::vector<Point>& points);

}  // namespace ice::sweep
