// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// Removes the centres of touching spheres whose winding number is a half or less: they are outside
/// the solid, whatever the normal of the nearest face (faces that cross each other, T-shaped
/// junctions).
///
/// The open ball of `radius` round a centre contains no surface, so all of it has one winding
/// number, and so have all balls that overlap: one centre per connected group is tested, exactly
/// (WindingNumber::contains).
/// @param centers  of spheres of `radius` [m] that touch the surface, from whichever side; their
///                 order is kept
/// @return how many were removed
std::int64_t drop_outside(const TriangleMesh& solid, double radius, std::vector<Vec3>& centers);

}  // namespace ice
