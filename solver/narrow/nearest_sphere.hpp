// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "solver/scene/bodies.hpp"
#include "solver/shape/shape.hpp"

namespace ice {

/// The surface sphere whose centre is nearest to a point in the shape's axes; of equals the one
/// that comes first in Shape::mirror_rank, then by number.
std::int32_t nearest_sphere(const Shape& shape, const Vec3& point);

/// How far the ice around a point of a body's axes has been crushed: as far as the nearest sphere,
/// along its normal [m].
double crushed_near(const Scene& scene, std::int32_t body, const Vec3& point);

}  // namespace ice
