// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "postprocess/report/tables.hpp"
#include "postprocess/sensitivity/rank_inputs.hpp"

namespace ice::sensitivity {

/// Error of the model, as shares of the mean [-] (common/base/uncertainty.hpp): in broken ice one
/// stated number, in level ice the least and the largest mean error against model tests.
struct ModelError {
    double least, largest;
    bool measured;  ///< in level ice
};

/// The tornado chart as one SVG element, 860 px wide: a bar from the case to each value, the input
/// that moves it most on top. Whiskers are 95 % intervals of the difference, cut where they leave
/// the chart; bars whose interval holds zero are pale. Bands behind them show the interval of the
/// case and the error of the model, of a measured one its least and its largest value. Bars without
/// a result are left out.
/// @param base of the case [N; 2D: N/m]; finite mean
std::string draw_tornado(const std::vector<RankedInput>& inputs, const Estimate& base,
                         const report::ForceUnit& unit, const ModelError& model);

}  // namespace ice::sensitivity
