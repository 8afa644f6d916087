// SPDX-License-Identifier: GPL-3.0-or-later
/// Ice that is crushed away: convex solids cut by planes.
#pragma once

#include "solver/shape/solid.hpp"

namespace ice {

/// The part of a convex piece within a half-space. Its planes, corners and edges follow from those
/// of the piece without any comparison of places, so that planes at any small angle stay apart.
///
/// The plane is moved outward where it would pass nearer than 0.1 mm to a corner of the piece: no
/// edge is as short as rounding.
/// @return the piece itself where the half-space holds all of it; empty where nothing is left, or
///         more corners than a piece may have
ConvexPiece cut_piece(const ConvexPiece& piece, HalfSpace within);

/// Takes the ice beyond a plane off a solid. A plane almost parallel to one of the solid's, or one
/// more plane than a cut solid may have, moves the nearest plane inward to the point instead.
/// @param outward  unit normal of the plane, out of the ice that stays @param point  on the plane
/// @return false where nothing would be left, or too many corners: the solid is unchanged
bool crush_solid(ConvexPiece& solid, const Vec3& outward, const Vec3& point);

}  // namespace ice
