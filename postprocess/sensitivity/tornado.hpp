// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "postprocess/report/tables.hpp"
#include "postprocess/sensitivity/rank_inputs.hpp"

namespace ice::sensitivity {

/// The tornado chart as one SVG element, 860 px wide: a bar from the case to each value, the input
/// that moves it most on top. Whiskers are 95 % intervals of the difference, cut where they leave
/// the chart; bars whose interval holds zero are pale. The case's own interval and the model
/// uncertainty are bands behind. Bars without a result are left out.
/// @param base of the case [N; 2D: N/m]; finite mean
std::string draw_tornado(const std::vector<RankedInput>& inputs, const Estimate& base,
                         const report::ForceUnit& unit);

}  // namespace ice::sensitivity
