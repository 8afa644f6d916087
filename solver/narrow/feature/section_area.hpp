// SPDX-License-Identifier: GPL-3.0-or-later
/// Areas of two convex solids that meet: the section on which they press, and their slices.
#pragma once

#include <vector>

#include "solver/narrow/feature/separating_axis.hpp"

namespace ice {

/// Work memory, which keeps its capacity between pairs.
struct SectionWork {
    std::vector<Vec3> face, rest;
};

/// The section on which two overlapping solids press [m2]: the part of b's surface that faces a and
/// lies inside a, projected on the normal. Two solids that overlap less than they are thick have
/// the same section from either side, by the divergence theorem. Of a corner in a face it is the
/// corner's section. Of two crossing edges it is half the product of their lengths inside the other
/// solid and of the sine between them.
/// @param n      unit, from a to b, a's axes
/// @param reach  [m] b's surface counts up to this far outside a's planes, so that faces that just
///               touch count whole
double section_area(const ConvexPiece& a, const ConvexPiece& b, const RelativePose& pose,
                    const Vec3& n, double reach, SectionWork& work);

/// Area of the slice of a piece by the plane n . x = offset [m2]; 0 beside the piece.
double slice_area(const ConvexPiece& piece, const Vec3& n, double offset);

}  // namespace ice
