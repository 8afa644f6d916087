// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// Points as rows of an [N,3] array of T, in their unit; empty for none.
template <class T>
std::vector<T> flatten(const std::vector<Vec3>& points) {
    std::vector<T> flat;
    flat.reserve(3 * points.size());
    for (const Vec3& p : points)
        for (int k = 0; k < 3; ++k) flat.push_back(static_cast<T>(p[k]));
    return flat;
}

}  // namespace ice
