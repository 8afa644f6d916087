// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/deep_pairs.hpp"

#include <algorithm>
#include <tuple>

namespace ice {

namespace {

// A pair is deep from this share of the ice's radius on, and its spheres' contacts may be less deep
// than the solids by as much. Less asks more pairs; from two radii on spheres miss each other.
constexpr double kDeep = 0.5;

double slack_of(const PairView& view) { return kDeep * view.shape_b.largest_radius; }

}  // namespace

bool is_deep(const PairView& view, double apart) {
    return !view.shape_a.convex.empty() && !view.shape_b.convex.empty() && apart < -slack_of(view);
}

const ContactPolygon* find_lost_polygon(const PairView& view, std::span<const Candidate> found,
                                        double most) {
    const ConvexPiece &a = view.shape_a.convex, &b = view.shape_b.convex;
    const RelativePose pose{view.turn, view.shift};
    const SeparatingAxes axes = find_axes(a, b, pose, 0.0);
    double least = 0.0;
    for (const Candidate& c : found) least = std::min(least, c.gap.gap);
    const double crushed =
        view.scene.crushed.deepest_of(view.pair.a) + view.scene.crushed.deepest_of(view.pair.b);
    if (axes.widest() + crushed + slack_of(view) >= least) return nullptr;
    thread_local ContactPolygon polygon;  // keeps its memory
    make_contact_polygon(a, b, pose, axes, most, polygon);
    reduce_polygon(kManifoldCorners, polygon);
    return polygon.corners.empty() ? nullptr : &polygon;
}

std::int32_t nearest_sphere(const Shape& shape, const Vec3& point) {
    std::int32_t nearest = 0;
    const auto key = [&](std::int32_t k) {
        const auto row = static_cast<std::size_t>(k);
        return std::tuple((shape.center[row] - point).squaredNorm(), shape.mirror_rank[row], k);
    };
    auto least = key(0);
    for (std::int32_t k = 1; k < std::ssize(shape.center); ++k)
        if (const auto now = key(k); now < least) {
            least = now;
            nearest = k;
        }
    return nearest;
}

}  // namespace ice
