// SPDX-License-Identifier: GPL-3.0-or-later
/// The separating axes of two convex pieces: how far they are apart, or how deep in each other.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "solver/shape/solid.hpp"

namespace ice {

/// Where piece b is in the axes of piece a: p_a = rotation p_b + translation.
struct RelativePose {
    Mat3 rotation;     ///< b's axes to a's
    Vec3 translation;  ///< [m]
};

/// The widest gaps between two convex pieces, one for each kind of axis [m].
///
/// Along the outward normal n of a plane of a the gap is min(n . x of b) - n . x on the plane, and
/// the other way round for b's. Two edges have the axis e_a x e_b where their arcs of normals cross
/// on the sphere of directions (Gauss map: e_a x e_b is a normal of a's edge and its opposite one
/// of b's); the gap is then that of their two lines. The faces of the Minkowski difference b - a
/// are these three kinds and no others, so the widest gap
///
///   * is minus the penetration depth where the pieces overlap: the shortest shift that separates
///     them;
///   * is at most their distance where they do not, and equal to it where a face or two edges are
///     nearest.
///
/// Source: D. Gregorius, The separating axis test between convex polyhedra, GDC 2013.
struct SeparatingAxes {
    static constexpr double kNone = -std::numeric_limits<double>::infinity();

    /// Edges whose sine squared is less [-] have no axis: their cross product has no digits left. A
    /// plane's normal beside it differs by as little (1e-6), so that nothing is lost. Smaller lets
    /// rounding choose an axis; larger leaves out axes that no plane is near.
    static constexpr double kParallelSquared = 1e-12;

    double face_a = kNone, face_b = kNone, edges = kNone;
    std::int32_t plane_a = -1, plane_b = -1;  ///< the first of those with the gap; -1: not measured
    std::int32_t edge_a = -1, edge_b = -1;    ///< the first pair, by a's edge, then b's; -1: none

    /// [m]; minus infinity where nothing was measured.
    double widest() const { return std::max({face_a, face_b, edges}); }
};

/// Measures the axes. Stops early after a's or b's planes where one of them has a gap of more than
/// `enough` [m]: then the pieces are that far apart, and the later kinds are left out.
/// Edges that are parallel by kParallelSquared have no axis.
/// Cost: planes times corners, then pairs of edges. @pre neither piece is empty
SeparatingAxes find_axes(const ConvexPiece& a, const ConvexPiece& b, const RelativePose& pose,
                         double enough);

/// The unit normal e_a x e_b of two edges, from a to b, a's axes. @pre find_axes gave the edges
Vec3 edge_axis(const ConvexPiece& a, const ConvexPiece& b, const RelativePose& pose,
               std::int32_t edge_a, std::int32_t edge_b);

/// The gap [m] along one plane of a (or, where plane_a < 0, of b): a cheap first test of the axis
/// that separated the pieces in the last step. Same bits as find_axes gives.
double gap_along_plane(const ConvexPiece& a, const ConvexPiece& b, const RelativePose& pose,
                       std::int32_t plane_a, std::int32_t plane_b);

namespace reference {
// The definition, one pair of features at a time: read this first. Same bits on every instruction
// set.
SeparatingAxes find_axes(const ConvexPiece& a, const ConvexPiece& b, const RelativePose& pose,
                         double enough);
}  // namespace reference

}  // namespace ice
