// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace ice {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// Triangles with a region name each: the surface of a hull or floe.
///
/// Counter-clockwise seen from outside. `region` has one row of `region_names` per triangle.
struct TriangleMesh {
    std::vector<Vec3> vertices;                          ///< V points [m]
    std::vector<std::array<std::int32_t, 3>> triangles;  ///< T triples of vertex indices
    std::vector<std::int32_t> region;                    ///< T rows of region_names
    std::vector<std::string> region_names{"hull"};       ///< row 0 is for unnamed parts

    /// Corner k of 0, 1, 2 [m]. @pre indices in range
    Vec3 corner(std::size_t triangle, int k) const {
        return vertices[static_cast<std::size_t>(triangles[triangle][static_cast<std::size_t>(k)])];
    }
    /// Normal times area [m2]: half the cross product of two edges; zero for a degenerate triangle.
    Vec3 area_vector(std::size_t triangle) const {
        const Vec3 a = corner(triangle, 0);
        return 0.5 * (corner(triangle, 1) - a).cross(corner(triangle, 2) - a);
    }
};

}  // namespace ice
