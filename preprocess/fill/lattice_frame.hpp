// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// How equal spheres of radius R are packed; rows run along x with pitch 2 R in both.
enum class LatticeKind {
    cubic,     ///< pitch 2 R along x, y and z; fills 0.52 of space
    hexagonal  ///< hexagonal close packing, layers square to y; fills 0.74 of space
};

/// Where the points of a lattice are: rows along x, numbered by j along y and k along z.
///
/// Hexagonal: layers ABAB lie square to y, 2 R sqrt(2/3) apart, the rows of a layer R sqrt(3) apart
/// along z. Rows of odd j lie a third of that higher; rows of odd j + k are shifted by R along x.
/// Stacked along y because the plane of a layer is a mirror plane of the packing, while stacked
/// along z no plane along the rows is one: a symmetric hull gets a layer in y = 0.
struct LatticeFrame {
    LatticeKind kind = LatticeKind::cubic;
    std::array<std::int64_t, 3> count{0, 0, 0};  ///< points along a row, rows along y, along z
    Vec3 first = Vec3::Zero();                   ///< of row 0, 0; its y at j = middle [m]
    Vec3 step = Vec3::Zero();                    ///< between points, along y, along z [m]
    double middle = 0.0;                         ///< j of y = 0 where the lattice is symmetric [-]

    /// Rows of equal parity of j share their heights: 1 such family, or 2.
    int families() const { return kind == LatticeKind::hexagonal ? 2 : 1; }
    std::size_t rows() const { return static_cast<std::size_t>(count[1] * count[2]); }
    std::size_t row(std::int64_t j, std::int64_t k) const {
        return static_cast<std::size_t>(k * count[1] + j);
    }
    /// 64-bit words of a row at one bit per point.
    std::size_t words() const { return static_cast<std::size_t>((count[0] + 63) / 64); }

    /// x of the first point of a row [m]; point i lies at start + step.x() * i, so rounded.
    double start(std::int64_t j, std::int64_t k) const {
        const bool shifted = kind == LatticeKind::hexagonal && ((j + k) & 1) != 0;
        return shifted ? first.x() + 0.5 * step.x() : first.x();
    }
    double y(std::int64_t j) const {
        return first.y() + step.y() * (static_cast<double>(j) - middle);
    }
    double z(std::int64_t j, std::int64_t k) const {
        return height(static_cast<int>(j) & 1) + step.z() * static_cast<double>(k);
    }
    /// z of row k = 0 of a family (j & 1) [m].
    double height(int family) const {
        const bool raised = kind == LatticeKind::hexagonal && family != 0;
        return raised ? first.z() + step.z() / 3.0 : first.z();
    }
    Vec3 point(std::int64_t i, std::int64_t j, std::int64_t k) const {
        return {start(j, k) + step.x() * static_cast<double>(i), y(j), z(j, k)};
    }
};

/// Places a lattice of touching spheres in a solid's box.
///
/// Along each axis: where flat faces square to it bound the box at both ends and the extent is a
/// multiple of the pitch, the lattice is tangent to both, so that the paper's floe of 1 x 0.8 x 0.3
/// m takes 10 x 8 x 3 spheres of 0.05 m. Otherwise it is tangent to the largest flat face; centred
/// in the box where there is none, where the two end faces are equally large, and along y for a
/// solid that is symmetric about y = 0 (its lattice is then symmetric, bit for bit). Hexagonal: the
/// rows of even j and k are so placed.
///
/// @param mirror  the solid is symmetric about y = 0
/// In 2D one layer of rows at y = 0. Cost O(triangles).
/// @throws Error (exit code 2) when the box holds more than 1e9 lattice points
LatticeFrame place_lattice(const TriangleMesh& mesh, LatticeKind kind, double radius, int dimension,
                           bool mirror);

}  // namespace ice
