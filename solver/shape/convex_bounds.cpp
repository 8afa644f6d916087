// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/shape/convex_bounds.hpp"

#include <algorithm>

namespace ice {

namespace {

// Normals whose cosine is above this [-] are one: facets of a flat face differ by rounding. Larger
// bounds fewer shapes, as one face has several normals; smaller joins facets of a curved face.
constexpr double kSameAxis = 1.0 - 1e-12;

// Tips are where the mesh's corners are to less than this [m], unless these are cut off. Larger
// takes small chamfers for none, smaller computes an excess of rounding.
constexpr double kSettled = 1e-6;

// Keeps v where the list has none that is the same; false where the list is full.
template <class Same>
bool keep(std::vector<Vec3>& list, const Vec3& v, const Same& same) {
    if (std::any_of(list.begin(), list.end(), [&](const Vec3& u) { return same(u, v); }))
        return true;
    if (list.size() == ConvexBounds::kMost) return false;
    list.push_back(v);
    return true;
}

bool list_corners(const TriangleMesh& mesh, std::vector<Vec3>& out) {
    return std::all_of(mesh.vertices.begin(), mesh.vertices.end(), [&](const Vec3& v) {
        return keep(out, v, [](const Vec3& l, const Vec3& r) { return l == r; });
    });
}

bool list_normals(const TriangleMesh& mesh, std::vector<Vec3>& out) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Vec3 across =
            (mesh.corner(t, 1) - mesh.corner(t, 0)).cross(mesh.corner(t, 2) - mesh.corner(t, 0));
        const double length = across.norm();
        if (length == 0.0) continue;
        const auto same = [](const Vec3& l, const Vec3& r) { return l.dot(r) > kSameAxis; };
        if (!keep(out, across / length, same)) return false;
    }
    return !out.empty();
}

// Is no corner before a facet, and no sphere by more than `excess`? Then the space behind all
// facets is the corners' hull, and a sphere, which is so but for a part of its radius, reaches out
// of it by that part. Sharp edges between facets only just not in one plane are right to 1e6
// kHeightRounding.
bool enclose_all(const TriangleMesh& mesh, const std::vector<Vec3>& corners,
                 std::span<const BoundedSphere> spheres, double excess) {
    // Rounding of a corner's height over a facet of its own face [m]. Larger takes meshes for
    // convex that are hollow by as much, smaller only costs time: separation() then proves less.
    constexpr double kHeightRounding = 1e-13;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Vec3 at = mesh.corner(t, 0);
        const Vec3 across = (mesh.corner(t, 1) - at).cross(mesh.corner(t, 2) - at);
        const double length = across.norm();
        if (length == 0.0) continue;
        const Vec3 n = across / length;
        for (const Vec3& v : corners)
            if (n.dot(v - at) > kHeightRounding) return false;
        for (const BoundedSphere& s : spheres)
            if (n.dot(s.center - at) + s.radius > excess + kHeightRounding || s.radius < excess)
                return false;
    }
    return true;
}

// The share of the line from a sphere's centre to its tip that is behind all planes. The rest of
// the line bounds the tip's distance from the corners' hull in every direction, not along normals
// alone.
double share_within(const ConvexBounds& bounds, const BoundedSphere& s) {
    double share = 1.0;
    for (std::size_t k = 0; k < bounds.normals.size(); ++k) {
        const double rise = bounds.normals[k].dot(s.tip);
        const double depth = bounds.offset[k] - bounds.normals[k].dot(s.center);
        if (rise > depth) share = std::min(share, depth / rise);
    }
    return share;
}

}  // namespace

ConvexBounds::ConvexBounds(const TriangleMesh& mesh, std::span<const BoundedSphere> spheres) {
    // too many corners or planes to be worth testing: the shape counts as unknown
    if (!list_corners(mesh, corners) || !list_normals(mesh, normals)) {
        corners.clear();
        normals.clear();
        return;
    }
    // Each normal's foremost corner bounds the mesh; spheres and tips may lie before it by the
    // excess, which separation() takes off.
    for (const Vec3& n : normals) {
        double foremost = n.dot(corners.front());
        for (const Vec3& v : corners) foremost = std::max(foremost, n.dot(v));
        offset.push_back(foremost);
        for (const BoundedSphere& s : spheres) {
            excess = std::max(excess, n.dot(s.center) + s.radius - foremost);
            excess = std::max(excess, n.dot(s.center + s.tip) - foremost);
        }
    }
    for (const BoundedSphere& s : spheres) {
        const double beyond = s.tip.norm() * (1.0 - share_within(*this, s));
        if (beyond > kSettled) excess = std::max(excess, beyond);
    }
    enclose_spheres = enclose_all(mesh, corners, spheres, excess);
}

}  // namespace ice
