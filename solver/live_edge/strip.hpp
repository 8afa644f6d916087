// SPDX-License-Identifier: GPL-3.0-or-later
/// Level ice in 2D: a sheet 1 m broad about y = 0, as solids of a section are, whose edge is its
/// tip and whose cracks go straight across (docs/method.md, section 5).
#pragma once

#include <vector>

#include "solver/level_ice/ice_sheet.hpp"
#include "solver/live_edge/edge_window.hpp"

namespace ice {

/// From x = `from` to `to` [m].
Eigen::AlignedBox2d strip_extent(double from, double to);

/// x of its tip, the smallest [m]; infinite where nothing is left. @pre in one part
double tip_of(const IceSheet& strip);

/// A section's outline (hull_outlines) made broader than the strip by `by` [m] on both sides: a
/// section has no sides that could crush ice.
Loop across_strip(Loop outline, double by);

/// The region that a crack cuts off, `length` [m] from the tip at x = `tip` [m].
Loop strip_crack(double tip, double length);

/// The load on the strip within `length` [m] of its tip, as one window there (equation (30a)); none
/// where the load does not press downwards.
std::vector<EdgeWindow> tip_window(const std::vector<EdgeLoad>& loads, double tip, double length);

/// The ice behind the tip that is contact geometry: to the third corner of cells from x = `origin`
/// on, which is two to three cells [m]. It changes with the tip alone. None where no ice is left.
std::vector<Loop> strip_tiles(const IceSheet& strip, double origin, double cell);

/// A part of the strip half a gap shorter at both ends; none where that is below `least` [m].
std::vector<Loop> strip_bodies(const Loop& part, double gap, double least);

/// Length along x [m].
double strip_length(const Loop& part);

}  // namespace ice
