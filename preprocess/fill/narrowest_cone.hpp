// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// A cone about an axis through the origin.
struct Cone {
    Vec3 axis;          ///< unit
    double half_angle;  ///< [rad]
};

/// The narrowest cone from the origin that holds all directions (unit vectors, at least one).
///
/// It touches two or three of them, so all pairs and triples are tried: O(n^4), for the handful of
/// faces that meet in a corner. Of more than 200 directions (a sphere that just fits into a finely
/// meshed round solid touches it nearly everywhere) the angle is an upper bound, about 1 % more.
/// Where the directions lie in no half space (a part exactly as thick as the sphere touches on
/// opposite sides) the axis is the first direction and the angle the largest to any other.
Cone narrowest_cone(std::span<const Vec3> directions);

}  // namespace ice
