// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/geometry/surface_tree.hpp"

namespace ice {

/// True when the solid is its own mirror image across y = 0, whatever its triangles: every vertex
/// and every triangle's centre has its image on the surface, within 1e-7 of the box's diagonal.
bool is_mirror_symmetric(const SurfaceTree& tree);

}  // namespace ice
