// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "postprocess/fit/fit_spencer.hpp"
#include "postprocess/sweep/sweep_points.hpp"

namespace ice::fit {

/// The points of a sweep as the fit takes them: runs in 3D with a resistance > 0 whose summaries
/// have the formula's inputs and the ship's mean speed. Others are passed over; none may be left.
/// @param flexural_strength [Pa] of level ice, in place of the runs' own; NaN: theirs
std::vector<FitPoint> fit_points(const sweep::Sweep& sweep, const std::vector<sweep::Point>& points,
                                 double flexural_strength);

/// Warnings of a fit: axes that the formula does not have; as many coefficients as points;
/// coefficients that are negative or not determined; runs with an affected mean, by how much.
std::vector<std::string> fit_warnings(const sweep::Sweep& sweep, const SpencerFit& fit);

/// Coefficients with intervals, then a row per point with both resistances, for a terminal.
std::string fit_text(const SpencerFit& fit, const std::vector<FitPoint>& points);

}  // namespace ice::fit
