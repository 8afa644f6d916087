// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/base/assert.hpp"
#include "common/geometry/triangle_mesh.hpp"

namespace ice {

struct Shape;

/// Side planes: the planes at which the faces and edges of surface spheres end.
///
/// A sphere represents the surface within the shape's patch radius, even where its face ends
/// nearer. The face ends at the planes of the neighbouring faces, which the spheres of nearby
/// convex edges and vertices store. An edge ends at a plane that is next to both of its faces.
///
/// Without side planes are: vertices, rounded edges, and spheres farther than twice the patch
/// radius and a radius from every edge. Concave edges, and convex ones that are hollow in plan,
/// give no side plane: no plane ends the face there without cutting off a part of it.
class SidePlanes {
public:
    SidePlanes() = default;
    /// @pre the shape's spheres, cones, mirror ranks and patch radius are set. The cost is that of
    /// the spheres near edges, times the edges' spheres near each.
    explicit SidePlanes(const Shape& shape);

    /// Has sphere k side planes?
    bool has(std::int32_t k) const {
        const auto n = static_cast<std::size_t>(k);
        return !planes_.empty() && first_[n] < first_[n + 1];
    }

    /// Is a point of the face's plane or the edge's line inside all side planes, to `slack` [m]?
    /// @pre has(k) @param point  body axes [m]
    bool contain(std::int32_t k, const Vec3& point, double slack) const {
        ICE_ASSERT(has(k));
        const auto n = static_cast<std::size_t>(k);
        return std::all_of(planes_.begin() + first_[n], planes_.begin() + first_[n + 1],
                           [&](const Plane& p) { return p.normal.dot(point) <= p.offset + slack; });
    }

private:
    struct Plane {
        Vec3 normal;    // outward, unit
        double offset;  // normal . x on the plane [m]
    };
    std::vector<Plane> planes_;          // by sphere
    std::vector<std::ptrdiff_t> first_;  // of planes_, by sphere, and the end
};

}  // namespace ice
