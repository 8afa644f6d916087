// SPDX-License-Identifier: GPL-3.0-or-later
/// Closed surfaces inside each other: which of them bound the solid.
#pragma once

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// Meaning of a mesh of several closed surfaces.
enum class SolidKind {
    envelope,  ///< the inside of the outermost surfaces: voids and double skins are filled
    material,  ///< by the surfaces' orientation: winding number not zero
};

/// Counts of choose_shells(), for the report.
struct ShellCounts {
    std::int64_t shells = 0;   ///< closed connected surfaces found
    std::int64_t flipped = 0;  ///< of those kept, turned over to face outwards of the solid
    std::int64_t dropped = 0;  ///< lying inside and bounding nothing of the solid
    std::int64_t flat = 0;     ///< dropped: enclosing no volume
};

/// Keeps the shells that bound the solid and makes them face away from it.
///
/// A shell lies inside another where the other's winding number there is not zero. For `material`
/// the winding number just outside a shell is the sum over the shells around it (+1 facing
/// outwards, -1 inwards) and just inside it one more or less: a shell that changes nothing from or
/// to zero is dropped. So an inward shell in an outward one is a void, an outward one a second
/// skin. For `envelope` a shell inside any other is dropped.
///
/// @pre    the mesh is closed and consistently oriented, and no triangles cross
/// @post   order of the remaining triangles unchanged; unused vertices removed
/// Cost O(S T) in the worst case for S shells inside each other's boxes.
ShellCounts choose_shells(TriangleMesh& mesh, SolidKind kind);

}  // namespace ice
