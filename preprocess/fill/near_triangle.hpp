// SPDX-License-Identifier: GPL-3.0-or-later
/// One triangle's part in clear_near().
#pragma once

#include <algorithm>
#include <cmath>

#include "common/geometry/closest_on_triangle.hpp"
#include "preprocess/fill/lattice_range.hpp"
#include "preprocess/fill/triangle_distances.hpp"

namespace ice::detail {

// Share of the squared distance [-] within which a quick answer is not trusted: far above the
// rounding of measure_distances(). A larger value decides more points again, one by one.
inline constexpr double kDoubt = 1e-5;
// |n_x| of a unit normal [-] from which a plane cuts a row within reach; flatter planes would
// divide by almost nothing. A larger value measures more points of rows along flat planes, a
// smaller one lets rounding move the cut by more.
inline constexpr double kSteep = 1e-3;
// Rounding of a normal over the square of the longest side [-]: a few units in the last place. A
// larger value leaves more slivers to the exact answer, a smaller one trusts normals of rounding.
inline constexpr double kNormalRounding = 1e-15;

using Corners = std::array<Vec3, 3>;

/// A triangle with the part of a row near it, and the features near that part.
class NearTriangle {
public:
    void prepare(const Vec3& a, const Vec3& b, const Vec3& c, double distance) {
        distance_ = distance;
        sides_.corner[0] = a;
        sides_.corner[1] = b;
        sides_.corner[2] = c;
        sides_.edge[0] = b - a;
        sides_.edge[1] = c - b;
        sides_.edge[2] = a - c;
        sides_.normal = sides_.edge[0].cross(sides_.edge[1]);
        const double area_sq = sides_.normal.squaredNorm();
        double longest_sq = 0.0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double length_sq = sides_.edge[k].squaredNorm();
            sides_.per_edge_sq[k] = 1.0 / length_sq;
            longest_sq = std::max(longest_sq, length_sq);
        }
        // the normal of a sliver is rounding: then only the exact answer counts
        const double turn = kNormalRounding * longest_sq, most = 0.1 * kSlack * distance;
        has_plane_ = turn * turn * (longest_sq + 4.0 * distance * distance) < most * most * area_sq;
        far_side_ = near_side_ = Vec3::Constant(distance * (1.0 + kSlack));
        if (!has_plane_) return;
        for (std::size_t k = 0; k < 3; ++k) sides_.inward[k] = sides_.normal.cross(sides_.edge[k]);
        sides_.per_area_sq = 1.0 / area_sq;
        reach_ = distance * (1.0 + kSlack) * std::sqrt(area_sq);
        above_ = kSlack * reach_;
        // of the ball of that radius around a point of the face, the half on the inner side
        for (int d = 1; d < 3; ++d) {
            const double n = sides_.normal[d];
            const double wide = std::sqrt(std::max(0.0, 1.0 - n * n * sides_.per_area_sq));
            (n > 0.0 ? far_side_ : near_side_)[d] = distance * (wide + 3.0 * kSlack);
        }
        steep_ = std::abs(sides_.normal.x()) * distance > kSteep * reach_;
        per_x_ = steep_ ? 1.0 / sides_.normal.x() : 0.0;
    }

    /// Narrows the part [from, to] of the row at y, z to the inner half of the plane's slab: the
    /// nearest triangle of a point inside the solid has the point on its inner side, or shares the
    /// nearest corner or edge with one that has.
    void narrow(double y, double z, double& from, double& to) const {
        if (!has_plane_) return;
        const Vec3 &a = sides_.corner[0], &n = sides_.normal;
        const double height = n.y() * (y - a.y()) + n.z() * (z - a.z());
        if (steep_) {
            const double top = a.x() + (above_ - height) * per_x_;
            const double bottom = a.x() - (reach_ + height) * per_x_;
            from = std::max(from, std::min(top, bottom));
            to = std::min(to, std::max(top, bottom));
            return;
        }
        const double turn =
            std::abs(n.x()) * std::max(std::abs(from - a.x()), std::abs(to - a.x()));
        if (height - turn > above_ || height + turn < -reach_) to = from - 1.0;
    }

    void measure(PointBatch& points, double* distance_sq) const {
        for (std::size_t k = points.count; k % PointBatch::kPadding != 0; ++k)
            points.x[k] = points.y[k] = points.z[k] = 0.0;
        if (has_plane_)
            measure_distances(sides_, points, distance_sq);
        else
            std::fill_n(distance_sq, points.count, distance_ * distance_);  // in doubt
    }

    /// Closer than the distance, from the result of measure().
    bool is_near(const PointBatch& points, std::size_t k, double distance_sq) const {
        const double square = distance_ * distance_;
        if (distance_sq > square * (1.0 + kDoubt)) return false;
        if (distance_sq < square * (1.0 - kDoubt)) return true;
        const Vec3 p(points.x[k], points.y[k], points.z[k]);
        const auto& c = sides_.corner;
        return (p - closest_on_triangle(p, c[0], c[1], c[2]).point).norm() < distance_;
    }

    /// How far the points that narrow() leaves reach beyond the triangle, along the axes or (side
    /// -1) against them [m].
    const Vec3& reach(int side) const { return side > 0 ? far_side_ : near_side_; }

private:
    TriangleSides sides_;
    double distance_ = 0.0;
    // heights over the plane are measured in units of the normal's length
    double reach_ = 0.0, above_ = 0.0, per_x_ = 0.0;
    Vec3 far_side_, near_side_;
    bool has_plane_ = false, steep_ = false;
};

}  // namespace ice::detail
