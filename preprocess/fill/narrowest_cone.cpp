// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/fill/narrowest_cone.hpp"

#include <algorithm>
#include <cmath>

namespace ice {

namespace {

// Cosines that differ by less are equal [-]: of equally narrow cones the first counts, so that the
// result does not depend on rounding. A larger value leaves cones wider by as much.
constexpr double kTie = 1e-12;
// Directions up to which all triples are tried [-], 2024 of them: the time grows with the fourth
// power of their number. A smaller value leaves more cones wider than the narrowest one.
constexpr std::size_t kMostTriples = 24;
// Directions up to which all pairs are tried [-]; their time grows with the third power. A smaller
// value leaves more cones to the iteration, which misses the narrowest one by a little.
constexpr std::size_t kMostPairs = 200;
// Turns of the iteration beyond [-]: the angle is then within about 1 % of itself. More come nearer
// to the narrowest cone and take longer.
constexpr int kTurns = 300;

double least_cosine(const Vec3& axis, std::span<const Vec3> directions) {
    double least = 1.0;
    for (const Vec3& d : directions) least = std::min(least, axis.dot(d));
    return least;
}

// Turned towards the direction farthest off, by less each time (Badoiu and Clarkson, SODA 2003).
Vec3 turned_axis(std::span<const Vec3> directions) {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& d : directions) sum += d;
    Vec3 axis = sum.norm() > 1e-9 ? Vec3(sum.normalized()) : directions.front();
    for (int turn = 1; turn <= kTurns; ++turn) {
        const Vec3* farthest = &directions.front();
        for (const Vec3& d : directions)
            if (axis.dot(d) < axis.dot(*farthest)) farthest = &d;
        // steps of 1 / (turn + 1): the error falls with the number of turns
        const Vec3 next = axis + (*farthest - axis) / (turn + 1.0);
        if (next.norm() < 1e-9) break;
        axis = next.normalized();
    }
    return axis;
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
    // The narrowest cone touches two directions or three (smallest enclosing circle on the sphere):
    // all pairs and triples are tried where they are few, an iteration towards the farthest
    // otherwise.
    const std::size_t n = directions.size();
    if (n > kMostPairs) try_axis(turned_axis(directions));
    for (std::size_t i = 0; i < n && n <= kMostPairs; ++i)
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
