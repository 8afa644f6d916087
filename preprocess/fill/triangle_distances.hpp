// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// Points beside each other in memory, so that several are measured at a time [m].
struct PointBatch {
    /// Points of a batch [-]: four vectors of AVX-512, 768 bytes on the stack. It sets the time
    /// alone.
    static constexpr std::size_t kMost = 32;
    /// Entries from `count` to the next multiple of this [-] are read, and must be finite.
    static constexpr std::size_t kPadding = 8;

    std::array<double, kMost> x, y, z;  ///< [m]; the first `count` are points
    std::size_t count = 0;
};

/// A triangle with area, prepared for many points.
struct TriangleSides {
    std::array<Vec3, 3> corner;         ///< a, b, c [m]
    std::array<Vec3, 3> edge;           ///< b - a, c - b, a - c [m]
    std::array<Vec3, 3> inward;         ///< normal x edge: in the plane, towards the face [m3]
    std::array<double, 3> per_edge_sq;  ///< 1 / |edge|^2 [1/m2]
    Vec3 normal;                        ///< edge 0 x edge 1, twice the area long [m2]
    double per_area_sq;                 ///< 1 / |normal|^2 [1/m4]
};

/// Squared distance of each point from the triangle:
///
///     (n . (p - a))^2 / n^2                      over the face: inward . (p - corner) >= 0
///     min over edges of |p - corner - s edge|^2  elsewhere, s = edge . (p - corner) / edge^2
///                                                limited to [0, 1]
///
/// @param out  at least `count` rounded up to a multiple of kPadding values [m2]; accurate to some
///             units in the last place of the squared distance from the farthest corner
/// Every lane is a point of its own: same bits as the reference on every instruction set.
void measure_distances(const TriangleSides& triangle, const PointBatch& points, double* out);

namespace reference {
/// The definition, one point at a time: read this first.
void measure_distances(const TriangleSides& triangle, const PointBatch& points, double* out);
}  // namespace reference

}  // namespace ice
