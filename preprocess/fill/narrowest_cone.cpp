// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/fill/narrowest_cone.hpp"

#include <algorithm>
#include <cmath>

namespace ice {

namespace {

constexpr double kTie = 1e-12;
constexpr std::size_t kMostTriples = 24;  // beyond that many directions pairs alone are tried

double least_cosine(const Vec3& axis, std::span<const Vec3> directions) {
    double least = 1.0;
    for (const Vec3& d : directions) least = std::min(least, axis.dot(d));
    return least;
}

}  // namespace

Cone narrowest_cone(std::span<const Vec3> directions) {
    Vec3 best = directions.front();
    double cosine = least_cosine(best, directions);
    const auto try_axis = [&](Vec3 axis) {
        const double length = axis.norm();
        if (length < 1e-9) return;
        axis /= length;
        const double now = least_cosine(axis, directions);
        if (now <= cosine + kTie) return;
        best = axis;
        cosine = now;
    };
    const std::size_t n = directions.size();
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = i + 1; j < n; ++j) {
            try_axis(directions[i] + directions[j]);
            for (std::size_t k = j + 1; k < n && n <= kMostTriples; ++k) {
                // at equal angles to all three: normal to the plane through their tips
                const Vec3 axis =
                    (directions[j] - directions[i]).cross(directions[k] - directions[i]);
                try_axis(axis);
                try_axis(-axis);
            }
        }
    return {best, std::acos(std::clamp(cosine, -1.0, 1.0))};
}

}  // namespace ice
