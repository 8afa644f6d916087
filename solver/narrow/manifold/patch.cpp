// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/manifold/patch.hpp"

#include <algorithm>
#include <cmath>

namespace ice {

namespace {

// Faces that lie this close together [m] touch: gaps are never exact. It is the depth in which a
// flat patch comes from nothing to its whole area; larger makes that softer, smaller makes the
// bound jump with the rounding of a gap.
constexpr double kTouch = 1e-4;

// An upright patch still has this share of its area [-], so that nothing passes through
// it. More adds force on sides that slide along; 0 lets a body cut along its own side unresisted.
constexpr double kLeastFacing = 0.05;

// Cosines of a normal cone's half angle below this [-] count as it: the point of touch would be
// anywhere. Larger shortens the wings of needles, smaller makes them as long as rounding has it.
constexpr double kLeastSpreadCos = 1e-3;

// Projected area of a wing of unit area as far as a face at `depth` below the foot cuts it; the
// wing descends from the foot at the angle with this sine and cosine, up where the sine is < 0.
double cut_wing(double sine, double cosine, double wing, double depth) {
    if (cosine <= 0.0) return 0.0;  // upright: no area along the normal
    // Of a wing that descends from the foot the face cuts the upper part. A wing that rises is
    // cut whole, or only its tip where the face has not reached the foot (depth < 0).
    const double rise = wing * std::abs(sine) + kTouch;
    const double part = sine > 0.0 ? (depth + kTouch) / rise : 1.0 + depth / rise;
    return cosine * std::clamp(part, 0.0, 1.0);
}

}  // namespace

double wing_length(double radius, double share, double spread_cos, double spread_sin) {
    // touch is r tan s, from the foot to the point of touch; the wing w solves 4 w (w - touch)
    // = share (patch.hpp)
    const double touch = radius * spread_sin / std::max(spread_cos, kLeastSpreadCos);
    return 0.5 * (touch + std::sqrt(touch * touch + share));
}

double cut_area(const Patch& patch, double depth) {
    depth = std::max(depth, 0.0);
    // The wings' normals are at s + t and s - t from the contact's normal: sines and cosines by
    // the addition theorems.
    const double ct = std::clamp(patch.facing, -1.0, 1.0), st = std::sqrt(1.0 - ct * ct);
    const double cs = patch.spread_cos, ss = patch.spread_sin;
    const double below_foot = depth - patch.foot;
    const double away = cut_wing(ss * ct + cs * st, cs * ct - ss * st, patch.wing, below_foot);
    const double other = cut_wing(ss * ct - cs * st, cs * ct + ss * st, patch.wing, below_foot);
    // where a wing faces backwards, or three meet in a corner, the signed sum is the whole section
    const double whole = std::max(cs * ct, 0.0);
    // at least 5 % of what the same depth cuts from an upright patch
    const double least = kLeastFacing * cut_wing(1.0, 1.0, patch.wing, depth);
    return patch.share * std::max(std::min(0.5 * (away + other), whole), least);
}

}  // namespace ice
