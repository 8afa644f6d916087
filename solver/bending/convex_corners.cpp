// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/bending/convex_corners.hpp"

#include <algorithm>

namespace ice {

namespace {

using Vec2 = Eigen::Vector2d;

// Does the path from a over b to c turn left? Corners on a straight line do not, and are left out.
bool turns_left(const Vec2& a, const Vec2& b, const Vec2& c) {
    const Vec2 u = b - a, v = c - b;
    return u.x() * v.y() - u.y() * v.x() > 0.0;
}

}  // namespace

std::vector<Vec2> convex_corners(std::vector<Vec2> points) {
    // Andrew's monotone chain: from left to right the lower side, from right to left the upper
    // one.
    std::sort(points.begin(), points.end(), [](const Vec2& l, const Vec2& r) {
        return l.x() < r.x() || (l.x() == r.x() && l.y() < r.y());
    });
    std::vector<Vec2> corners;
    const auto add_chain = [&](auto begin, auto end) {
        const std::size_t first = corners.size();
        for (auto p = begin; p != end; ++p) {
            while (corners.size() >= first + 2 &&
                   !turns_left(corners[corners.size() - 2], corners.back(), *p))
                corners.pop_back();
            corners.push_back(*p);
        }
        if (corners.size() > first + 1) corners.pop_back();  // begins the other chain
    };
    add_chain(points.begin(), points.end());
    add_chain(points.rbegin(), points.rend());
    return corners;
}

}  // namespace ice
