// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// Nodes of a regular grid of cubes, x fastest.
struct Grid {
    Vec3 origin = Vec3::Zero();  ///< node 0 [m]
    double step = 1.0;           ///< [m]
    std::array<std::int32_t, 3> nodes{};

    /// Count of nodes.
    std::size_t size() const {
        return static_cast<std::size_t>(nodes[0]) * static_cast<std::size_t>(nodes[1]) *
               static_cast<std::size_t>(nodes[2]);
    }
    Vec3 at(std::size_t index) const {
        const auto nx = static_cast<std::size_t>(nodes[0]), ny = static_cast<std::size_t>(nodes[1]);
        const std::size_t i = index % nx, j = index / nx % ny, k = index / (nx * ny);
        return origin +
               step * Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
    }
};

/// Marks as inside all nodes that cannot be reached from the grid's border through nodes outside,
/// along the edges that contour_grid cuts.
void fill_voids(const Grid& grid, std::vector<std::uint8_t>& inside);

/// Surface between the nodes inside and those outside: marching tetrahedra, each cube cut into the
/// six around its diagonal (Kuhn), so that it is a closed manifold whatever the nodes say, faces
/// outwards and crosses itself nowhere. `inside` has one entry per node, 0 on the grid's border.
/// @param cut  share of the way from the inner to the outer end of an edge [-], called once per
///             crossed edge from several threads; kept within 0.02 and 0.98 so that no triangle
///             vanishes
TriangleMesh contour_grid(const Grid& grid, const std::vector<std::uint8_t>& inside,
                          const std::function<double(const Vec3& in, const Vec3& out)>& cut);

}  // namespace ice
