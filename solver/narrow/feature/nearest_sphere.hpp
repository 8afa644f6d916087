// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "solver/shape/shape.hpp"

namespace ice {

/// The surface sphere whose centre, before any crushing, is nearest to a point [m] in the shape's
/// axes; of equals the one that comes first in Shape::mirror_rank, then by number. Every shape has
/// one. Cost: a test of each cluster's box, and the spheres of the nearest clusters.
std::int32_t nearest_sphere(const Shape& shape, const Vec3& point);

}  // namespace ice
