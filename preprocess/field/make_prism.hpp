// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/geometry/triangle_mesh.hpp"
#include "preprocess/field/outline.hpp"

namespace ice {

/// A floe as a closed solid: the outline from z = -thickness / 2 to +thickness / 2, its upper and
/// lower edges cut off at 45 degrees over `chamfer` (0 for sharp ones), all in [m]. One region,
/// "ice".
///
/// @pre the outline is simple and anticlockwise; 0 <= chamfer < thickness / 2
/// @throws Error (exit code 2) naming chamfer when it leaves nothing of an edge
TriangleMesh make_prism(const Outline& outline, double thickness, double chamfer);

}  // namespace ice
