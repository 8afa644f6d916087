// SPDX-License-Identifier: GPL-3.0-or-later
// The widest gap of two convex solids, section 3: the definition, one pair of features at a time.
// separating_axis_simd.cpp computes the same bits in lanes.
#include <Eigen/Geometry>
#include <cmath>

#include "common/base/assert.hpp"
#include "common/math/ordered_products.hpp"
#include "solver/narrow/feature/separating_axis.hpp"

namespace ice {

namespace {

// All rows in the same order, as the kernel has it.
Vec3 turned(const Mat3& m, const Vec3& v) {
    return {ordered_dot(Vec3(m.row(0)), v), ordered_dot(Vec3(m.row(1)), v),
            ordered_dot(Vec3(m.row(2)), v)};
}

Vec3 placed(const RelativePose& pose, const Vec3& v) {
    return turned(pose.rotation, v) + pose.translation;
}

// Gap of the plane n . x = offset, outward normal n, to a point set given by its corners.
template <class Corner>
double gap_to(const Vec3& n, double offset, std::size_t corners, const Corner& corner) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < corners; ++k) least = std::min(least, ordered_dot(n, corner(k)));
    return least - offset;
}

double gap_of_plane_a(const ConvexPiece& a, const ConvexPiece& b, const RelativePose& pose,
                      std::size_t k) {
    return gap_to(a.normals[k], a.offsets[k], b.corners.size(),
                  [&](std::size_t c) { return placed(pose, b.corners[c]); });
}

double gap_of_plane_b(const ConvexPiece& a, const ConvexPiece& b, const RelativePose& pose,
                      std::size_t k) {
    const Vec3 n = turned(pose.rotation, b.normals[k]);
    const double offset = b.offsets[k] + ordered_dot(n, pose.translation);
    return gap_to(n, offset, a.corners.size(), [&](std::size_t c) { return a.corners[c]; });
}

// Do the arcs from the normals a1 to a2 and from -b1 to -b2 cross? Along them the edges go, ea
// along a1 x a2 and eb along b1 x b2.
bool arcs_cross(const Vec3& a1, const Vec3& a2, const Vec3& ea, const Vec3& b1, const Vec3& b2,
                const Vec3& eb) {
    // Gauss map: the arcs cross if b1 and b2 lie on two sides of the plane of a1 and a2, if a1
    // and a2 lie on two sides of that of b1 and b2, and if both arcs lie on one hemisphere. The
    // edges are the normals of these planes (Gregorius 2013).
    const double b1_ea = ordered_dot(b1, ea), b2_ea = ordered_dot(b2, ea);
    const double a1_eb = ordered_dot(a1, eb), a2_eb = ordered_dot(a2, eb);
    return b1_ea * b2_ea < 0.0 && a1_eb * a2_eb < 0.0 && b1_ea * a2_eb < 0.0;
}

}  // namespace

Vec3 edge_axis(const ConvexPiece& a, const ConvexPiece& b, const RelativePose& pose,
               std::int32_t edge_a, std::int32_t edge_b) {
    const auto ka = static_cast<std::size_t>(edge_a), kb = static_cast<std::size_t>(edge_b);
    // away from a: of the two senses the one on the side of the edge's own normals
    const Vec3 across = a.edge_along[ka].cross(turned(pose.rotation, b.edge_along[kb]));
    const bool outward = ordered_dot(across, a.edge_left[ka] + a.edge_right[ka]) >= 0.0;
    return (outward ? 1.0 : -1.0) / std::sqrt(ordered_dot(across, across)) * across;
}

double gap_along_plane(const ConvexPiece& a, const ConvexPiece& b, const RelativePose& pose,
                       std::int32_t plane_a, std::int32_t plane_b) {
    return plane_a >= 0 ? gap_of_plane_a(a, b, pose, static_cast<std::size_t>(plane_a))
                        : gap_of_plane_b(a, b, pose, static_cast<std::size_t>(plane_b));
}

namespace reference {

SeparatingAxes find_axes(const ConvexPiece& a, const ConvexPiece& b, const RelativePose& pose,
                         double enough) {
    ICE_ASSERT(!a.empty() && !b.empty());
    SeparatingAxes out;
    // a's planes against b's corners
    for (std::size_t k = 0; k < a.normals.size(); ++k) {
        const double gap = gap_of_plane_a(a, b, pose, k);
        if (gap <= out.face_a) continue;
        out.face_a = gap;
        out.plane_a = static_cast<std::int32_t>(k);
    }
    if (out.face_a > enough) return out;
    // b's planes against a's corners
    for (std::size_t k = 0; k < b.normals.size(); ++k) {
        const double gap = gap_of_plane_b(a, b, pose, k);
        if (gap <= out.face_b) continue;
        out.face_b = gap;
        out.plane_b = static_cast<std::int32_t>(k);
    }
    if (out.face_b > enough) return out;
    // edges with edges; a pair whose arcs do not cross is no face of the Minkowski difference
    for (std::size_t ka = 0; ka < a.edges.size(); ++ka)
        for (std::size_t kb = 0; kb < b.edges.size(); ++kb) {
            const Vec3 ea = a.edge_along[ka], eb = turned(pose.rotation, b.edge_along[kb]);
            const Vec3 b1 = turned(pose.rotation, b.edge_left[kb]),
                       b2 = turned(pose.rotation, b.edge_right[kb]);
            if (!arcs_cross(a.edge_left[ka], a.edge_right[ka], ea, b1, b2, eb)) continue;
            const Vec3 across = ea.cross(eb);
            const double square = ordered_dot(across, across);
            if (square <= SeparatingAxes::kParallelSquared) continue;
            // all points of two crossing lines have the same distance along their common normal
            const double apart =
                ordered_dot(across, placed(pose, b.edge_middle[kb]) - a.edge_middle[ka]);
            const bool outward = ordered_dot(across, a.edge_left[ka] + a.edge_right[ka]) >= 0.0;
            const double gap = (outward ? apart : -apart) / std::sqrt(square);
            if (gap <= out.edges) continue;
            out.edges = gap;
            out.edge_a = static_cast<std::int32_t>(ka);
            out.edge_b = static_cast<std::int32_t>(kb);
        }
    return out;
}

}  // namespace reference

}  // namespace ice
