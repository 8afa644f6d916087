// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/case/case.hpp"
#include "solver/scene/bodies.hpp"

namespace ice {

/// Sets Bodies::breaking_load of all floes that have none yet, from their groups: the load of
/// solver/bending for a floe held until it bends, in its present pose [N], 2D [N/m]; inf for all
/// others. Left empty if none bends.
void set_breaking_loads(Scene& scene, const Case& parameters);

}  // namespace ice
