// SPDX-License-Identifier: GPL-3.0-or-later
/// Contact manifold of two convex pieces: where they meet along their separating axis.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

#include "solver/narrow/feature/separating_axis.hpp"

namespace ice {

/// Lengths within which two convex pieces are judged.
struct PolygonTolerances {
    /// A face of a is the reference until one of b is this much farther away, and faces until two
    /// edges are [m]: faces that lie flush differ by rounding, and shall keep their contacts from
    /// step to step. More makes gaps wrong by as much; less lets the reference, and with it the
    /// contacts' ids, change between steps.
    static constexpr double kPrefer = 5e-5;

    /// A corner this far beyond a side plane of the reference face counts as over the face [m]:
    /// side planes of flush faces differ by rounding. More gives contacts beside the face; less
    /// loses corners on its side planes.
    static constexpr double kBesidePlane = 1e-4;

    /// A face takes the place of two edges if its normal differs from their axis by less [rad]: the
    /// two edges have one point, the face has all that may meet in the step. Floes that lie on each
    /// other with a small twist would be held in one point, another one in each step, and rock
    /// deeper and deeper. More gives contacts a normal along which edges slide into each other;
    /// less lets floes rock, and lets faces meet edges a step late.
    static constexpr double kSameAxis = 0.03;
};

/// One corner of the polygon in which two pieces meet.
struct PolygonCorner {
    Vec3 point;  ///< midway between the surfaces, a's axes [m]
    double gap;  ///< along the axis, negative where the pieces overlap [m]
    std::uint64_t
        id;  ///< by the features that meet there: the same corner keeps it from step to step
};

/// Orders corners by place with y and -y alike: mirror images are solved in the same order.
inline auto place_key(const PolygonCorner& c) {
    return std::tuple(c.point.x(), std::abs(c.point.y()), c.point.z(), c.gap, c.id);
}

/// The corners in which two pieces meet, and their common normal.
struct ContactPolygon {
    Vec3 normal = Vec3::Zero();  ///< unit, from a to b, a's axes
    std::vector<PolygonCorner> corners;
};

/// A corner of the incident face as it is clipped, in the reference's axes [m]; `edge` names the
/// edge from it to the next one: of the incident face or along a side plane.
struct ClippedCorner {
    Vec3 at;
    std::uint32_t edge;
};

/// Work memory of append_face_corners.
struct FaceCornersWork {
    std::vector<Vec3> places;     ///< of the incident piece's corners, the reference's axes [m]
    std::vector<double> heights;  ///< of these over the face [m]
    std::vector<double> beyond;   ///< how far they are beyond each side plane, by corner [m]
    std::vector<std::uint64_t> outside;  ///< the side planes that a corner is beyond, as bits
    std::vector<double> facing;  ///< cosine of each incident plane and the face's normal [-]
    std::vector<char> turned;    ///< by incident corner: is one of its planes turned to the face?
};

/// Work memory of make_contact_polygon, which keeps its capacity between pairs.
struct ClippingWork {
    FaceCornersWork corners;
    std::vector<Vec3> face;                    ///< the incident face before it is clipped
    std::vector<ClippedCorner> polygon, rest;  ///< what is left of it, before and after a cut
    std::vector<double> height;                ///< of the polygon over a side plane [m]
};

/// Which faces of the incident piece meet the reference.
enum class IncidentFaces {
    /// All that are turned against it (append_face_corners).
    all,
    /// The one whose normal is most opposed, clipped. For parts of a body: their cuts are no faces,
    /// and corners on a cut are none of the body.
    most_opposed,
};

/// The corners of the polygon in which two convex pieces meet, as far as their gap is at most
/// `most` [m]; keeps `out`'s memory.
///
/// The axis with the widest gap decides. Where it is a face's, that face is the reference, and the
/// corners are those of the other piece's surface over it (IncidentFaces). Two edges meet in one
/// point, midway between them where they are nearest. With IncidentFaces::all a face is the
/// reference in their place if its normal is nearly theirs (PolygonTolerances::kSameAxis) and the
/// pieces are as deep, or as near, over it. A face that has not touched yet may be past a side
/// plane by its gap: it may come from beside. An axis that is preferred by
/// PolygonTolerances::kPrefer may have no corner, because its face is beside the contact; then the
/// widest one is taken. No corner is deeper than the widest axis says. No corners where every gap
/// exceeds `most`.
///
/// Source of the clipping: Sutherland and Hodgman, Reentrant polygon clipping, CACM 17, 1974.
/// @param axes  find_axes() of these pieces and this pose, all kinds
void make_contact_polygon(const ConvexPiece& a, const ConvexPiece& b, const RelativePose& pose,
                          const SeparatingAxes& axes, IncidentFaces which, double most,
                          ClippingWork& work, ContactPolygon& out);

/// The point midway between the two edges of the widest axis where their lines are nearest, but no
/// farther along either edge than its end; its gap is the axis's. @pre the axis is that of edges
PolygonCorner edge_corner(const ConvexPiece& a, const ConvexPiece& b, const RelativePose& pose,
                          const SeparatingAxes& axes);

/// Is the axis with the widest gap that of two edges? Flush ones as axis_normal().
bool is_edge_axis(const SeparatingAxes& axes);

/// The axis with the widest gap, unit, from a to b, a's axes; flush ones by PolygonTolerances, a's
/// face before b's before two edges.
Vec3 axis_normal(const ConvexPiece& a, const ConvexPiece& b, const RelativePose& pose,
                 const SeparatingAxes& axes);

/// This many corners [-] carry nearly the same forces and moments as a polygon with more. Three
/// carry no load outside their triangle; each further one costs a row in the contact solver.
constexpr std::size_t kManifoldCorners = 4;

/// Puts the corners of several polygons with one normal in order around their middle.
/// @pre there are some
void order_around(ContactPolygon& polygon);

/// Removes the corner whose loss takes the least area until `count` remain; the deepest stays.
/// @pre count > 2
void reduce_polygon(std::size_t count, ContactPolygon& polygon);

}  // namespace ice
