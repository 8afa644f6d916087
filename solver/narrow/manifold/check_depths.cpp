// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/manifold/check_depths.hpp"

#include <algorithm>
#include <numbers>

#include "solver/narrow/feature/deep_pair.hpp"
#include "solver/narrow/feature/way_out.hpp"
#include "solver/narrow/manifold/deep_seats.hpp"
#include "solver/narrow/manifold/find_polygon.hpp"

namespace ice {

namespace {

// Distance of a point behind a right-angled edge from this edge, divided by that from the nearest
// face [-]. With 1, as for a face, true crossings become shallower by a third; a larger one lets
// contacts be deeper that edges far apart seem to make.
constexpr double kBehindEdge = std::numbers::sqrt2;

// Depth of a point in the ice that is left of a body [m]; negative outside and in a notch.
double depth_in(const PairView& view, std::int32_t body, const Vec3& in_a) {
    const bool of_b = body == view.pair.b;
    const Vec3 p = of_b ? view.to_b(in_a) : in_a;
    const Foot foot = (of_b ? view.shape_b : view.shape_a).surface->closest(p);
    return foot.inside ? way_out(view.scene, body, p, foot).depth : -foot.distance;
}

// How deep one body is in the other at the tip of a feature [m]. The tip may be cut off by the mesh
// or by a notch: the body ends by as much before it.
// @param tip  of the feature, a's axes
double depth_at_tip(const PairView& view, std::int32_t of, std::int32_t in, const Vec3& tip) {
    return depth_in(view, in, tip) + std::min(0.0, depth_in(view, of, tip));
}

// Where two edges cross: on either one the point nearest to the other, a's axes.
struct Crossing {
    Vec3 on_a, on_b;
};

Crossing crossing_of(const PairView& view, const Candidate& c) {
    // A feature is unbounded along its edges: only the meshes show whether the two edges extend to
    // the crossing of their lines.
    const Vec3 a = view.support_a(c.i, c.gap.normal), b = view.support_b(c.j, -c.gap.normal);
    const Vec3 along_a = view.shape_a.cone[c.i].edge(c.gap.edge_a);
    const Vec3 along_b = view.rotation_ab * view.shape_b.cone[c.j].edge(c.gap.edge_b);
    const LineParameters at = closest_on_lines(a, along_a, b, along_b);
    return {a + at.along_a * along_a, b + at.along_b * along_b};
}

// Bounds a candidate's depth by the meshes; false where its point is not in the other solid (of a
// crossing: not in both).
bool bound_by_meshes(const PairView& view, Candidate& c) {
    // A point that moves by its depth along its way out has left the other solid, so the contact
    // is at most as deep; along the normal it may be less deep. The bodies may be deeper at other
    // points: the seats find those.
    const auto [a, b] = view.pair;
    double depth = 0.0;
    if (c.gap.crossing) {
        // Two edges cross within both solids, or one of them ends before. The middle is nearer to
        // both surfaces than the contact is deep, so that it bounds no depth.
        const Crossing at = crossing_of(view, c);
        const Vec3 middle = 0.5 * (at.on_a + at.on_b);
        if (depth_in(view, a, middle) <= 0.0 || depth_in(view, b, middle) <= 0.0) return false;
        depth = kBehindEdge *
                std::min(depth_at_tip(view, a, b, at.on_a), depth_at_tip(view, b, a, at.on_b));
    } else {
        const Vec3& n = c.gap.normal;
        depth = c.gap.reference_is_a ? depth_at_tip(view, b, a, view.support_b(c.j, -n))
                                     : depth_at_tip(view, a, b, view.support_a(c.i, n));
    }
    c.gap.gap = std::max(c.gap.gap, -depth);
    return depth > 0.0;
}

}  // namespace

void check_depths(const PairView& view, std::vector<Candidate>& candidates) {
    // In 3D only (docs/method.md, section 3); of two convex solids the separating axis gives
    // the depth.
    if (view.shape_a.dimension == 2 || is_convex_pair(view)) return;
    const double slack = deep_slack(view);
    std::erase_if(candidates,
                  [&](Candidate& c) { return c.gap.gap < -slack && !bound_by_meshes(view, c); });
}

}  // namespace ice
