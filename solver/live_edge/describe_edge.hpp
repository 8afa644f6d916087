// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "common/formats/particulars.hpp"
#include "solver/live_edge/live_edge.hpp"

namespace ice {

/// Size of cracks and channel beside published ranges, and the uses of the sheet's area: one
/// line each. The ranges are as later papers print them, not read in their sources.
///
/// Crushed ice and brash below 1e-9 of the sheet are rounding, and 0 (without_rounding()).
std::string describe_edge(const LiveEdge& edge);

/// Means over the pieces that broke off; none in 2D, and where no piece did.
std::optional<CrackParticulars> measure_cracks(const LiveEdge& edge);

IceAreas without_rounding(IceAreas areas);

}  // namespace ice
