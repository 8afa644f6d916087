// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "preprocess/fill/make_layer.hpp"

namespace ice {

/// The seats along the solid's sharp edges, or in 2D along its outline: evenly spaced between the
/// corners, at most `spacing` apart, none nearer than half of it to one of another line. In a
/// corner where edges end and that has room for a sphere one touches all three faces, however near
/// the next corner is.
/// With `mirror` only those with y >= 0.
std::vector<Seat> seat_lines(const SurfaceTree& tree, const LayerOptions& options);

}  // namespace ice
