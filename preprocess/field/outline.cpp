// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/field/outline.hpp"

#include <cmath>
#include <numbers>

namespace ice {

namespace {

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

const Vec2& next(const Outline& outline, std::size_t k) {
    return outline[(k + 1) % outline.size()];
}

const Vec2& previous(const Outline& outline, std::size_t k) {
    return outline[(k + outline.size() - 1) % outline.size()];
}

}  // namespace

// Diameter of the disc of equal area: the "size" of floes in reports and specifications.
double size_of(const Outline& outline) {
    return 2.0 * std::sqrt(area_of(outline) / std::numbers::pi);
}

bool is_convex(const Outline& outline) {
    for (std::size_t k = 0; k < outline.size(); ++k)
        // Outlines run counterclockwise: a convex one turns left at each corner, or is straight.
        if (cross(outline[k] - previous(outline, k), next(outline, k) - outline[k]) < 0.0)
            return false;
    return true;
}

Outline without_straight_corners(const Outline& outline) {
    // Sine of the turn [-] up to which a corner counts as straight: rounding of its coordinates. A
    // larger value takes corners out of round outlines, a smaller one keeps corners that rounding
    // made.
    constexpr double kStraight = 1e-9;
    Outline out;
    for (std::size_t k = 0; k < outline.size(); ++k) {
        const Vec2 before = outline[k] - previous(outline, k),
                   after = next(outline, k) - outline[k];
        const bool straight =
            std::abs(cross(before, after)) <= kStraight * before.norm() * after.norm();
        // A corner that turns back by 180 degrees has the sine 0, too, but is the tip of a needle.
        if (!straight || before.dot(after) < 0.0) out.push_back(outline[k]);
    }
    return out;
}

Outline inset(const Outline& outline, double distance) {
    Outline out;
    for (std::size_t k = 0; k < outline.size(); ++k) {
        const Vec2 before = (outline[k] - previous(outline, k)).normalized();
        const Vec2 after = (next(outline, k) - outline[k]).normalized();
        const Vec2 n1(-before.y(), before.x()), n2(-after.y(), after.x());  // inward
        // the point at `distance` from both edges' lines: p + d (n1 + n2) / (1 + n1 . n2)
        const double fold = 1.0 + n1.dot(n2);
        if (fold < 1e-6) return {};  // a needle
        out.push_back(outline[k] + distance / fold * (n1 + n2));
    }
    for (std::size_t k = 0; k < outline.size(); ++k)
        // An edge that has turned round has shrunk to nothing: the inset has no such shape.
        if ((next(out, k) - out[k]).dot(next(outline, k) - outline[k]) <= 0.0) return {};
    return out;
}

}  // namespace ice
