// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// Counts of drop_repeats().
struct RepeatCounts {
    std::int64_t copies = 0;  ///< triangles lying on another with the same three corners
    std::int64_t walls = 0;   ///< triangles of walls without thickness inside a closed surface
};

/// Triangles with the same three corners, whichever way they face: one of them stays where its
/// edges need it, that is where they have an odd number of other triangles; a wall that only hangs
/// on the surface is removed altogether. An edge without any other triangle does not count: it may
/// be a crack. @pre the mesh is welded. Cost O(T).
RepeatCounts drop_repeats(TriangleMesh& mesh);

}  // namespace ice
