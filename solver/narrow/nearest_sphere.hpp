// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "solver/scene/bodies.hpp"
#include "solver/shape/shape.hpp"

namespace ice {

/// The surface sphere whose centre, before any crushing, is nearest to a point [m] in the shape's
/// axes; of equals the one that comes first in Shape::mirror_rank, then by number. Every shape has
/// one. Cost: the boxes of all groups of 16, and the spheres of those that may be nearer.
std::int32_t nearest_sphere(const Shape& shape, const Vec3& point);

/// Depth of the notch at a surface sphere [m], for a point that leaves the ice along `outward`, a
/// unit vector in body axes: the depth to which the sphere was crushed against this direction, or
/// along its own normal where that is more. A point that came in through the side of an edge may be
/// nearer to its upper face.
double notch_depth(const Scene& scene, std::int32_t body, std::int32_t sphere, const Vec3& outward);

}  // namespace ice
