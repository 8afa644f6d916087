// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/fill/mirror_seat.hpp"

#include <cmath>

namespace ice {

namespace {

// Newton steps at most [-]. Where more are needed, faces alternate and no sphere fits in the plane.
// Fewer lose seats in the centre plane, more take longer where none is.
constexpr int kMostMirrorSteps = 40;

// Newton on the distance, along its gradient within the centre plane.
std::optional<Seat> on_centre_plane(const SurfaceTree& tree, const Seat& seat, double radius) {
    Vec3 c = seat.center;
    c.y() = 0.0;
    std::int32_t hint = seat.triangle;
    for (int step = 0; step < kMostMirrorSteps; ++step) {
        const Foot foot = tree.closest(c, hint);
        hint = foot.triangle;
        const double lack = radius - foot.distance;
        if (!foot.inside) return std::nullopt;
        const Vec3 out = (foot.point - c) / foot.distance;
        if (std::abs(lack) <= exact_distance(c, radius)) {
            // in the plane of symmetry it touches port and starboard
            Seat middle{c, out, foot.triangle};
            find_crease(tree, radius, middle);
            return middle;
        }
        // the part of the step in the centre plane; across it the mirror image balances
        const Vec3 away(-out.x(), 0.0, -out.z());
        if (away.norm() < 0.1) return std::nullopt;
        c += lack / away.squaredNorm() * away;
    }
    return std::nullopt;
}

}  // namespace

std::optional<Seat> mirror_seat(const SurfaceTree& tree, Seat seat, double radius, double gap) {
    if (std::abs(seat.center.y()) < 1e-6 * radius) {
        if (seat.center.y() != 0.0) seat.touches = 0;
        seat.center.y() = 0.0;
    }
    // the half y >= 0 is made, the other is its image
    if (seat.center.y() < 0.0) seat = image_of(seat);
    if (seat.center.y() > 0.0 && seat.center.y() < gap) return on_centre_plane(tree, seat, radius);
    return seat;
}

Seat image_of(const Seat& seat) {
    Seat image = seat;
    image.center.y() = -image.center.y();
    image.normal.y() = -image.normal.y();
    image.touches = 0;
    return image;
}

}  // namespace ice
