// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

struct Shape;

/// Where the faces and edges end that surface spheres stand for.
///
/// A sphere stands for its face or edge as far as the shape's reach all around, also where that
/// ends nearer by. It ends at the planes of the faces that come next, which the spheres of outward
/// edges and corners nearby know. An edge ends at a plane that is next to both of its faces.
///
/// Spheres without borders: corners, rounded edges, those farther than twice the reach and a
/// radius from every edge. Inward edges, and outward ones that are hollow in plan, are no borders:
/// no plane ends the face there without cutting off some of it.
class FaceBorders {
public:
    FaceBorders() = default;
    /// @pre the shape's spheres, faces, mirror ranks and reach are known. Costs as much as there
    /// are spheres near edges, times the edges' spheres near each.
    explicit FaceBorders(const Shape& shape);

    /// Has what sphere k stands for any border?
    bool has(std::int32_t k) const {
        const auto n = static_cast<std::size_t>(k);
        return !planes_.empty() && first_[n] < first_[n + 1];
    }

    /// Is a point of the face's plane or the edge's line before all borders, or past none by more
    /// than `slack` [m]? @pre has(k) @param point  body axes [m]
    bool hold(std::int32_t k, const Vec3& point, double slack) const {
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
