// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// Where the line through two points meets a plane: the same bits from either end.
/// @param height_p, height_q  of the points over the plane [m]; not equal
inline Vec3 plane_crossing(const Vec3& p, double height_p, const Vec3& q, double height_q) {
    return (height_p * q - height_q * p) / (height_p - height_q);
}

}  // namespace ice
