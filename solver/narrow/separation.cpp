// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/separation.hpp"

#include <algorithm>
#include <limits>

#include "solver/broad/travel.hpp"

namespace ice {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The widest gap along the planes of `from` to a body whose axes are turned and shifted to them.
double widest_gap(const ConvexBounds& from, const ConvexBounds& other, const Mat3& turn,
                  const Vec3& shift) {
    double widest = -kInfinity;
    for (std::size_t k = 0; k < from.normals.size(); ++k) {
        const Vec3 along = turn.transpose() * from.normals[k];
        double nearest = kInfinity;
        for (const Vec3& v : other.corners) nearest = std::min(nearest, along.dot(v));
        widest = std::max(widest, nearest + from.normals[k].dot(shift) - from.offset[k]);
    }
    return widest;
}

}  // namespace

double separation(const PairView& view) {
    const ConvexBounds &a = view.shape_a.bounds, &b = view.shape_b.bounds;
    if (!a.known() || !b.known()) return -kInfinity;
    const Mat3 back = view.turn.transpose();
    const double widest = std::max(widest_gap(a, b, view.turn, view.shift),
                                   widest_gap(b, a, back, -(back * view.shift)));
    return widest - a.excess - b.excess;
}

double separation_share(const PairView& view) {
    // a turn moves the other body's far end by its distance from there, and counts as Travel::arm
    const double apart = view.shift.norm();
    return std::max({1.0, (apart + view.shape_b.bounding_radius) / Travel::arm(view.shape_a),
                     (apart + view.shape_a.bounding_radius) / Travel::arm(view.shape_b)});
}

}  // namespace ice
