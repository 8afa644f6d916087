// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/shape/normal_cone.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/base/assert.hpp"

namespace ice {

NormalCone NormalCone::meeting(std::span<const Vec3> normals) {
    NormalCone out;
    out.count = static_cast<int>(normals.size());
    for (std::size_t k = 0; k < normals.size(); ++k) out.normal[k] = normals[k];
    const Vec3 &f = out.normal[0], &g = out.normal[1], &h = out.normal[2];
    if (out.count == 2) {
        // `part` and `size` turn "is n in the cone" into dot products: n = sum of (n . part_k /
        // size) times normal_k, with no negative factor. Two faces have the dual basis in their
        // plane and the edge's direction, three the reciprocal vectors.
        const double c = f.dot(g);
        out.part = {f - c * g, g - c * f, f.cross(g).normalized()};
        out.size = 1.0 - c * c;
    }
    if (out.count == 3) {
        const double volume = f.dot(g.cross(h)), sign = volume < 0.0 ? -1.0 : 1.0;
        out.part = {sign * g.cross(h), sign * h.cross(f), sign * f.cross(g)};
        out.size = std::abs(volume);
    }
    if (out.count > 1)
        for (std::size_t k = 0; k < 3; ++k) {
            const double length = out.part[k].norm();
            out.per_length[k] = length > 0.0 ? 1.0 / length : 0.0;  // 0: parallel faces
        }
    return out;
}

NormalCone NormalCone::turned(const Mat3& turn) const {
    NormalCone out = *this;
    if (count == 0) return out;
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k)
        out.normal[k] = turn * normal[k];
    for (std::size_t k = 0; k < 3; ++k) out.part[k] = turn * part[k];
    return out;
}

double NormalCone::least_along(const Vec3& n, double around) const {
    ICE_ASSERT(count > 0);
    // into the solid it is opposite to the parts: along each of a corner's edges, or within each of
    // an edge's faces and along the edge; a face's or the solid's points go so far along several
    const auto along = [&](std::size_t k) { return n.dot(part[k]) * per_length[k]; };
    const double last = count == 2 ? std::abs(n.dot(part[2])) : along(2);
    return -around * (std::max(along(0), 0.0) + std::max(along(1), 0.0) + std::max(last, 0.0));
}

}  // namespace ice
