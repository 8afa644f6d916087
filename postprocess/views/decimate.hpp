// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "postprocess/views/svg.hpp"

namespace ice::views {

/// Thins a curve for drawing and keeps every peak.
///
/// The x range is cut into `bins`; of each bin the lowest and the highest point stay, in the order
/// they had, so that a hit of one sample is seen however long the curve is. Points that are not
/// finite are left out. Curves of up to 2 * bins points come back whole.
/// @param x rising; @param y as many values; @param bins a count; 0 thins nothing
std::vector<Vec2> decimate(const std::vector<double>& x, const std::vector<double>& y,
                           std::size_t bins);

}  // namespace ice::views
