// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/geometry/loop_area.hpp"

#include "common/base/assert.hpp"

namespace ice {

namespace {

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace

// about the first corner, so that a loop far from the origin loses no digits
double area_of(const Loop& loop) {
    double twice = 0.0;
    for (std::size_t k = 1; k + 1 < loop.size(); ++k)
        twice += cross(loop[k] - loop[0], loop[k + 1] - loop[0]);
    return 0.5 * twice;
}

Vec2 centroid_of(const Loop& loop) {
    Vec2 sum = Vec2::Zero();
    double twice = 0.0;
    for (std::size_t k = 1; k + 1 < loop.size(); ++k) {
        const Vec2 a = loop[k] - loop[0], b = loop[k + 1] - loop[0];
        // the centroid of a triangle with one corner at 0 is (a + b) / 3, its weight the signed
        // area
        sum += cross(a, b) * (a + b);
        twice += cross(a, b);
    }
    ICE_ASSERT(twice != 0.0);
    return loop[0] + sum / (3.0 * twice);
}

double length_of(const Loop& loop) {
    double sum = 0.0;
    for (std::size_t k = 0; k < loop.size(); ++k)
        sum += (loop[(k + 1) % loop.size()] - loop[k]).norm();
    return sum;
}

}  // namespace ice
