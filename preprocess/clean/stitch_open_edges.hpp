// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// Counts of stitch_open_edges(), for the report.
struct StitchCounts {
    std::int64_t merged = 0;  ///< vertices merged with a vertex across the crack
    std::int64_t split = 0;   ///< open edges split at the vertices across the crack
    double widest = 0.0;      ///< of the cracks [m]: as far as a vertex or an edge was moved
};

/// Closes cracks between patches that were tessellated one by one, whose vertices on a common
/// curve differ (IGES exports): vertices of open edges that nearly meet become one, and an open
/// edge runs through the vertices of others beside it. Cracks may be as wide as 3e-4 of the
/// diagonal, then as 1e-3, both up to four times, as each stitch makes room for more; nowhere are
/// they wider than a third of the open edges there, so that no edge collapses. The first of merged
/// vertices keeps its place, as do all others. Cost O(B log B) for B open edges.
/// @pre the mesh is welded
StitchCounts stitch_open_edges(TriangleMesh& mesh);

/// Cracks that are too wide to be stitched.
struct WideCracks {
    std::int64_t vertices = 0;        ///< of open edges
    std::int64_t beside_another = 0;  ///< of them: beside an open edge that is not their own
    double widest = 0.0;              ///< of the cracks there [m]
};

/// Open edges that others run beside, nearer than 0.9 of their own lengths: around an opening, an
/// edge that is not a vertex's own begins a whole length away. Cost O(B log B).
WideCracks find_wide_cracks(const TriangleMesh& mesh);

}  // namespace ice
