// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "common/geometry/loop_area.hpp"

namespace ice {

/// A polygon cut into convex ones along diagonals, as corners of the outline, anticlockwise: no
/// corner is added. At most four times as many as the fewest (Hertel and Mehlhorn, 1983, by CGAL).
///
/// @param outline  anticlockwise, without repeating the first corner
/// @return the outline alone where it is convex; nothing where it is not simple
std::vector<std::vector<std::int32_t>> convex_parts(const Loop& outline);

}  // namespace ice
