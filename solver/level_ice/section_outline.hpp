// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/geometry/loop_area.hpp"
#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// A body's outline [m] at the height z [m] of the mesh's axes: the convex hull of the section,
/// anticlockwise. Empty where the height misses the mesh.
Loop section_outline(const TriangleMesh& mesh, double z);

}  // namespace ice
