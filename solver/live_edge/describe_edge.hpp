// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "solver/live_edge/live_edge.hpp"

namespace ice {

/// Size of cracks and channel beside published ranges, and the uses of the sheet's area: one
/// line each. The ranges are as later papers print them, not read in their sources.
///
/// Crushed ice and brash below 1e-9 of the sheet are rounding, and 0 (without_rounding()).
std::string describe_edge(const LiveEdge& edge);

IceAreas without_rounding(IceAreas areas);

}  // namespace ice
