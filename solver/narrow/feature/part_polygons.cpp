// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/feature/part_polygons.hpp"

#include <algorithm>

#include "common/math/ordered_products.hpp"

namespace ice {

namespace {

// Parts that meet along one face have normals that are this near (cosine [-]). Larger joins faces
// that are not one, smaller keeps four corners of each part.
constexpr double kSameNormal = 1.0 - 1e-9;

// Corners nearer to each other are one [m]: two parts have the corners at the end of their cut in
// common. Larger joins corners of small faces, smaller keeps two contacts at one point.
constexpr double kSamePoint = 1e-6;

// Of two corners at one point the deeper one is kept.
void add_once(const PolygonCorner& corner, std::vector<PolygonCorner>& out) {
    const auto same = std::find_if(out.begin(), out.end(), [&](const PolygonCorner& c) {
        return (c.point - corner.point).squaredNorm() < kSamePoint * kSamePoint;
    });
    if (same == out.end())
        out.push_back(corner);
    else if (corner.gap < same->gap)
        *same = corner;
}

// Moves the corners that have the first one's normal to `out`, at most four of them: parts that
// meet along one face of a body carry no more than the whole face does.
void take_one_normal(PartsWork& work, std::vector<MetCorner>& out) {
    auto& [clipping, polygon, corners, lost] = work;
    const Vec3 normal = corners.front().normal;
    const auto rest = std::stable_partition(
        corners.begin() + 1, corners.end(),
        [&](const MetCorner& c) { return c.normal.dot(normal) >= kSameNormal; });
    polygon.normal = normal;
    polygon.corners.clear();
    for (auto c = corners.begin(); c != rest; ++c) add_once(c->corner, polygon.corners);
    order_around(polygon);
    reduce_polygon(kManifoldCorners, polygon);
    for (const PolygonCorner& corner : polygon.corners) out.push_back({corner, normal});
    corners.erase(corners.begin(), rest);
}

// Does the part lie beyond a cut of the other one? Then it meets the parts on that side.
// @param pose  of `part` in the axes of `other`
bool is_beyond_cut(const SolidPart& other, const SolidPart& part, const RelativePose& pose) {
    return std::any_of(other.cuts.begin(), other.cuts.end(), [&](const SidePlane& cut) {
        const Vec3 along = ordered_transposed(pose.rotation, cut.outward);
        const double offset = cut.offset - ordered_dot(cut.outward, pose.translation);
        for (std::size_t k = 0; k < part.solid.corners.size(); ++k)
            if (ordered_dot(along, part.solid.corners[k]) <= offset) return false;
        return true;
    });
}

// Cosine of a face's normal and the reference's [-], 102 degrees, from which on the face is not the
// incident one where a cut is turned against the reference more: clipped and measured along the
// reference's normal, a face nearly upright to it has corners anywhere. Larger lets such faces
// meet, smaller loses deep bodies.
constexpr double kLeastFacing = -0.2;

// Has the part a face that is turned against the reference's? Else a part beyond a cut has it.
// @param n  the reference's normal in the part's axes
bool faces(const SolidPart& part, const Vec3& n) {
    double least = 1.0;
    for (std::size_t k = 0; k < part.solid.plane_count(); ++k)
        least = std::min(least, ordered_dot(part.solid.normals[k], n));
    return least < kLeastFacing ||
           std::none_of(part.cuts.begin(), part.cuts.end(),
                        [&](const SidePlane& cut) { return ordered_dot(cut.outward, n) < least; });
}

// How deep the parts are in each other if their cuts are planes like all others [m].
double depth_with_cuts(const SolidPart& a, const SolidPart& b, const RelativePose& pose) {
    return -find_axes(a.closed, b.closed, pose, 0.0).widest();
}

// Adds corners of parts that overlap deeper than all corners found. An edge may pass over a hollow
// corner. The rims of two parts end there, at the cut between them, and the edge crosses both lines
// beyond these ends. The corner is at the end, and the cuts bound its depth.
void add_lost(const RelativePose& pose, PartsWork& work) {
    double least = 0.0;  // gap of the corners found [m]
    for (const MetCorner& c : work.corners) least = std::min(least, c.corner.gap);
    for (const auto& [a, b, axes, number] : work.lost) {
        // cuts can only make the overlap smaller
        if (axes.widest() >= least) continue;
        const double gap = -depth_with_cuts(*a, *b, pose);
        if (gap >= least) continue;
        PolygonCorner corner = edge_corner(a->solid, b->solid, pose, axes);
        corner.gap = gap;
        corner.id |= number << 32;
        work.corners.push_back({corner, axis_normal(a->solid, b->solid, pose, axes)});
    }
}

// Least depth of two parts with their cuts as planes, divided by their depth without [-]. Parts
// with a smaller ratio overlap by a thin piece beside a cut, and the neighbouring part has the
// contact. A larger value loses contacts near cuts, a smaller one keeps contacts along wrong axes.
constexpr double kLeastDepth = 0.5;

// Appends the corners in which two parts meet.
void meet_parts(const SolidPart& a, const SolidPart& b, const RelativePose& pose, double most,
                std::uint64_t number, PartsWork& work) {
    auto& [clipping, polygon, corners, lost] = work;
    const SeparatingAxes axes = find_axes(a.solid, b.solid, pose, most);
    if (axes.widest() > most) return;
    const Vec3 n = axis_normal(a.solid, b.solid, pose, axes);
    if (!faces(b, ordered_transposed(pose.rotation, n)) || !faces(a, -n)) return;
    make_contact_polygon(a.solid, b.solid, pose, axes, IncidentFaces::most_opposed, most, clipping,
                         polygon);
    if (polygon.corners.empty() && axes.widest() < 0.0 && is_edge_axis(axes))
        lost.push_back({&a, &b, axes, number});
    // deeper than the range of contacts: the overlap may be the neighbouring part's
    if (!polygon.corners.empty() && axes.widest() < -most &&
        depth_with_cuts(a, b, pose) < -kLeastDepth * axes.widest())
        return;
    for (PolygonCorner& corner : polygon.corners) {
        corner.id |= number << 32;
        corners.push_back({corner, polygon.normal});
    }
}

}  // namespace

void find_part_polygons(std::span<const SolidPart> a, std::span<const SolidPart> b,
                        const RelativePose& pose, double most, PartsWork& work,
                        std::vector<MetCorner>& out) {
    work.corners.clear();
    work.lost.clear();
    const RelativePose back{pose.rotation.transpose(),
                            -ordered_transposed(pose.rotation, pose.translation)};
    std::uint64_t number = 0;  // of the pair of parts
    for (const SolidPart& part_a : a)
        for (const SolidPart& part_b : b) {
            ++number;
            const Vec3 apart =
                ordered_product(pose.rotation, part_b.middle) + pose.translation - part_a.middle;
            const double near = part_a.radius + part_b.radius + most;
            if (ordered_dot(apart, apart) > near * near) continue;
            if (is_beyond_cut(part_a, part_b, pose) || is_beyond_cut(part_b, part_a, back))
                continue;
            meet_parts(part_a, part_b, pose, most, number, work);
        }
    add_lost(pose, work);
    const auto first = std::ssize(out);
    while (!work.corners.empty()) take_one_normal(work, out);
    std::sort(out.begin() + first, out.end(), [](const MetCorner& l, const MetCorner& r) {
        return place_key(l.corner) < place_key(r.corner);
    });
}

}  // namespace ice
