// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/feature/separation.hpp"

#include <algorithm>
#include <limits>

#include "solver/broad/motion_bounds.hpp"

namespace ice {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The gap along plane k of `from` to a body whose axes are rotated and translated to them; where it
// is no more than `least`, anything between.
double gap_along(const ConvexBounds& from, std::size_t k, const ConvexBounds& other,
                 const Mat3& rotation, const Vec3& translation, double least) {
    // n . (rotation v + translation) for each corner v: the normal is turned, not all corners
    const Vec3 along = rotation.transpose() * from.normals[k];
    const double rest = from.normals[k].dot(translation);
    double nearest = kInfinity;
    for (const Vec3& v : other.corners) {
        nearest = std::min(nearest, along.dot(v));
        // an axis that is already no better than the best one needs no exact value
        if (nearest + rest - from.offset[k] <= least) break;
    }
    return nearest + rest - from.offset[k];
}

}  // namespace

double separation(const PairView& view, double enough, std::size_t& axis) {
    const ConvexBounds &a = view.shape_a.bounds, &b = view.shape_b.bounds;
    // without bounds nothing can be ruled out
    if (!a.known() || !b.known()) return -kInfinity;
    const Mat3 back = view.rotation_ab.transpose();
    const Vec3 translation_back = -(back * view.translation_ab);
    const std::size_t axes_a = a.normals.size(), axes = axes_a + b.normals.size();
    // The polyhedra bound the meshes; spheres protrude from them by at most the excess.
    const double excess = a.excess + b.excess;
    double widest = -kInfinity;
    const auto attempt = [&](std::size_t k) {
        const double gap = k < axes_a
                               ? gap_along(a, k, b, view.rotation_ab, view.translation_ab, widest)
                               : gap_along(b, k - axes_a, a, back, translation_back, widest);
        if (gap <= widest) return;
        widest = gap;
        axis = k;
    };
    // the axis of the last step first: mostly it still separates, and then no other is needed
    const std::size_t first = axis;
    if (first < axes) attempt(first);
    for (std::size_t k = 0; k < axes && widest - excess <= enough; ++k)
        if (k != first) attempt(k);
    return widest - excess;
}

double separation(const PairView& view) {
    std::size_t axis = 0;
    return separation(view, kInfinity, axis);
}

double separation_share(const PairView& view) {
    // a rotation moves the other body's far end by its distance from there, and counts as
    // MotionBounds::lever
    const double apart = view.translation_ab.norm();
    return std::max({1.0,
                     (apart + view.shape_b.bounding_radius) / MotionBounds::lever(view.shape_a),
                     (apart + view.shape_a.bounding_radius) / MotionBounds::lever(view.shape_b)});
}

}  // namespace ice
