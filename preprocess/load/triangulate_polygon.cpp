// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/load/triangulate_polygon.hpp"

#include <Eigen/Geometry>
#include <numeric>

namespace ice {

namespace {

// Twice the area as a vector: right for every planar polygon, a mean for the others.
Vec3 doubled_area(const std::vector<Vec3>& p) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 1; k + 1 < p.size(); ++k) sum += (p[k] - p[0]).cross(p[k + 1] - p[0]);
    return sum;
}

double turn(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& normal) {
    return (b - a).cross(c - b).dot(normal);
}

// An ear: a convex corner whose triangle holds no other corner.
bool is_ear(const std::vector<Vec3>& p, const std::vector<std::size_t>& left, std::size_t k,
            const Vec3& normal) {
    const std::size_t n = left.size();
    const std::size_t before = left[(k + n - 1) % n], at = left[k], after = left[(k + 1) % n];
    if (turn(p[before], p[at], p[after], normal) <= 0.0) return false;
    for (const std::size_t other : left) {
        if (other == before || other == at || other == after) continue;
        const bool inside = turn(p[before], p[at], p[other], normal) >= 0.0 &&
                            turn(p[at], p[after], p[other], normal) >= 0.0 &&
                            turn(p[after], p[before], p[other], normal) >= 0.0;
        if (inside) return false;
    }
    return true;
}

}  // namespace

std::vector<std::array<std::size_t, 3>> triangulate_polygon(const std::vector<Vec3>& corners) {
    const Vec3 normal = doubled_area(corners);
    std::vector<std::size_t> left(corners.size());
    std::iota(left.begin(), left.end(), std::size_t{0});
    std::vector<std::array<std::size_t, 3>> out;
    if (corners.size() == 4) {
        bool convex = true;
        for (std::size_t k = 0; k < 4; ++k)
            convex = convex && turn(corners[k], corners[(k + 1) % 4], corners[(k + 2) % 4],
                                    normal) > 0.0;
        if (convex) {
            // a tie must not be decided by rounding: mirrored sides would be cut differently
            const double first = (corners[2] - corners[0]).norm();
            const double second = (corners[3] - corners[1]).norm();
            if (second < first * (1.0 - 1e-9)) return {{0, 1, 3}, {1, 2, 3}};
            return {{0, 1, 2}, {0, 2, 3}};
        }
    }
    while (left.size() > 3) {
        const std::size_t n = left.size();
        std::size_t ear = 0;
        while (ear < n && !is_ear(corners, left, ear, normal)) ++ear;
        if (ear == n) ear = 0;  // no area or crossing itself: go on all the same
        out.push_back({left[(ear + n - 1) % n], left[ear], left[(ear + 1) % n]});
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    out.push_back({left[0], left[1], left[2]});
    return out;
}

}  // namespace ice
