// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "common/geometry/loop_area.hpp"
#include "solver/scene/bodies.hpp"

namespace ice {

/// The ship's outlines [m] at the upper and the lower face of ice, world axes (section_outline);
/// none at a height that misses the hull. @param top, bottom  world heights of the faces [m]
std::vector<Loop> hull_outlines(const Scene& scene, double top, double bottom);

}  // namespace ice
