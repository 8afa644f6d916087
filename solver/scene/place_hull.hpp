// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/case/case.hpp"

namespace ice {

/// World position of the hull's origin at t = 0 [m], from hull.draught or hull.position.
///
/// The draught is measured from the mesh's lowest point, wherever its origin is; it wins over the z
/// of hull_position, which means nothing then: read the height here, or from the scene.
Vec3 hull_place(const Case& parameters, const TriangleMesh& hull);

/// The place of a ship's hull that floats on water [m].
/// @throws Error (exit code 2) with the numbers where no ship floats so: a draught that is not
///         above 0, or a hull wholly under water
Vec3 place_hull(const Case& parameters, const TriangleMesh& hull);

}  // namespace ice
