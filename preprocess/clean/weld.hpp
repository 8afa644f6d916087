// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// What weld() did, for the report.
struct WeldCounts {
    std::int64_t merged_vertices = 0;       ///< moved onto another one; equal ones do not count
    std::int64_t degenerate_triangles = 0;  ///< dropped: two equal corners after merging
    std::int64_t duplicate_triangles = 0;   ///< dropped: same three corners, same side
};

/// Merges vertices that are equal or within 1e-6 of the mesh's diagonal, and drops triangles that
/// collapse or repeat. Unused vertices go. The first of merged vertices keeps its position, so the
/// result does not depend on anything but the order in the file.
WeldCounts weld(TriangleMesh& mesh);

}  // namespace ice
