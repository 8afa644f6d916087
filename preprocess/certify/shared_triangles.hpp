// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// Vertices of a mesh by their place.
class PlacedVertices {
public:
    /// @param tolerance  over the diagonal [-]: places that near are one, except where a grid of
    ///                   twice that width separates them; 0: equal coordinates, bit for bit
    PlacedVertices(const TriangleMesh& mesh, double tolerance);

    /// The first vertex at a place; -1 where there is none.
    std::int32_t find(const Vec3& p) const;

private:
    std::array<double, 3> key(const Vec3& p) const;

    double grid_ = 0.0;                                                   // [m]
    std::vector<std::pair<std::array<double, 3>, std::int32_t>> places_;  // sorted
};

/// For each triangle of a mesh 1 where another mesh has a triangle with the same three corners, in
/// whatever order; [T] one entry per triangle of `mesh`.
/// @param places  of the vertices of `other`, by equal coordinates
std::vector<std::uint8_t> shared_triangles(const TriangleMesh& mesh, const TriangleMesh& other,
                                           const PlacedVertices& places);

}  // namespace ice
