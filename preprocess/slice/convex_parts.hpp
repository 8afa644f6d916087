// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "common/geometry/loop_area.hpp"

namespace ice {

/// A polygon cut along diagonals into the fewest convex ones, as corners of the outline,
/// anticlockwise: no corner is added. Cost: the fourth power of the number of corners (Greene, The
/// decomposition of polygons into convex parts, 1983, by CGAL).
///
/// @param outline  anticlockwise, without repeating the first corner
/// @return the outline alone where it is convex; nothing where it is not simple
std::vector<std::vector<std::int32_t>> convex_parts(const Loop& outline);

}  // namespace ice
