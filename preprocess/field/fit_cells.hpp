// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "preprocess/field/power_cells.hpp"

namespace ice {

/// Cells of given areas: moves the weights until every cell has its own.
///
/// The weights maximise a concave function whose gradient is area - wanted; its second derivatives
/// are edge length / (2 distance of the sites) for neighbours. Newton's method, its step halved
/// until no cell falls below half the smallest so far or wanted, and the error falls (Kitagawa,
/// Merigot, Thibert, J. Eur. Math. Soc. 21, 2019).
///
/// @param areas    [m2], one per site, their sum the rectangle's
/// @param weights  in: a start (zeros if its cells are empty anywhere); out: the solution [m2]
/// @param tolerance  largest error of an area over the smallest wanted area [-]
/// @return the cells; their areas are met but for the tolerance, or as near as 60 steps came
std::vector<PowerCell> fit_cells(const std::vector<Vec2>& sites, const std::vector<double>& areas,
                                 const Rectangle& rectangle, double tolerance,
                                 std::vector<double>& weights);

}  // namespace ice
