// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "postprocess/report/histories.hpp"
#include "postprocess/report/pack.hpp"
#include "postprocess/statistics/bottom_coverage.hpp"

namespace ice::report {

/// Packs the curves of the charts and returns their description, one entry per chart, as
/// web/src/plots.js reads it. The page has an element with the same data-chart for each.
/// No histories give an empty list.
/// @param average_from start of the statistics [s], shown by shading
nlohmann::json pack_charts(const std::vector<History>& histories,
                           const statistics::BottomCoverage& coverage, double average_from,
                           Pack& pack);

}  // namespace ice::report
