// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/patch.hpp"

#include <algorithm>
#include <cmath>

namespace ice {

namespace {

// Faces that lie this close together [m] touch: gaps are never exact.
constexpr double kTouch = 1e-4;

// A patch that stands upright still has this share of its area, so that nothing passes through it.
constexpr double kLeastFacing = 0.05;

// Projected area of a wing of unit area turned by the angle with this sine and cosine, as far as
// it is cut; `half_side` is the wing's extent.
double cut_wing(double sine, double cosine, double half_side, double depth) {
    if (cosine <= 0.0) return 0.0;   // stands upright: no area along the normal
    if (sine <= 0.0) return cosine;  // turned towards the face
    return cosine * std::min(1.0, (depth + kTouch) / (half_side * sine + kTouch));
}

}  // namespace

double cut_area(const Patch& patch, double depth) {
    depth = std::max(depth, 0.0);
    const double ct = std::clamp(patch.facing, -1.0, 1.0), st = std::sqrt(1.0 - ct * ct);
    const double cs = patch.spread_cos, ss = patch.spread_sin;
    const double half_side = 0.5 * std::sqrt(patch.share);
    const double away = cut_wing(ss * ct + cs * st, cs * ct - ss * st, half_side, depth);
    const double other = cut_wing(ss * ct - cs * st, cs * ct + ss * st, half_side, depth);
    // where a wing faces backwards, or three meet in a corner, the signed sum is the whole section
    const double whole = std::max(cs * ct, 0.0);
    const double least = kLeastFacing * cut_wing(1.0, 1.0, half_side, depth);
    return patch.share * std::max(std::min(0.5 * (away + other), whole), least);
}

}  // namespace ice
