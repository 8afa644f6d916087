// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/check_depths.hpp"

#include <algorithm>

#include "solver/narrow/deep_seats.hpp"
#include "solver/narrow/solid_contacts.hpp"

namespace ice {

namespace {

Foot foot_in_a(const PairView& view, const Vec3& p) { return view.shape_a.surface->closest(p); }
Foot foot_in_b(const PairView& view, const Vec3& p) {
    return view.shape_b.surface->closest(view.to_b(p));
}

// Midway between the points of the two edges that are nearest to each other, a's axes.
Vec3 crossing_of(const PairView& view, const Candidate& c) {
    // A feature is unbounded along its edges: only the meshes tell whether the two edges still are
    // there where their lines cross.
    const Vec3 a = view.support_a(c.i, c.gap.normal), b = view.support_b(c.j, -c.gap.normal);
    const Vec3 along_a = view.shape_a.cone[c.i].edge(c.gap.edge_a);
    const Vec3 along_b = view.rotation_ab * view.shape_b.cone[c.j].edge(c.gap.edge_b);
    const LineParameters at = closest_on_lines(a, along_a, b, along_b);
    return 0.5 * (a + at.along_a * along_a + b + at.along_b * along_b);
}

// Bounds a candidate's depth by the meshes; false where its point is not in the other solid (of a
// crossing: not in both).
bool hold_to_meshes(const PairView& view, Candidate& c) {
    // Two edges cross within both solids, or one of them ends before. Where they do, the depth
    // along the axis stays as it is: it is measured between the edges' own lines. A bound by the
    // distances of the middle point from both meshes was tried and dropped: overlaps became deeper
    // (docs/design-notes.md).
    if (c.gap.crossing) {
        const Vec3 at = crossing_of(view, c);
        return foot_in_a(view, at).inside && foot_in_b(view, at).inside;
    }
    const Vec3& n = c.gap.normal;
    // The incident support point is a point of its body, or the tip of an edge that the mesh may
    // have cut off. A move of that length, to the nearest point of the other surface, takes this
    // point out of the other solid: its depth is no larger. It may be smaller along the normal,
    // so the smaller depth counts. Other points of the bodies may be deeper: the seats find them.
    const Foot foot = c.gap.reference_is_a ? foot_in_a(view, view.support_b(c.j, -n))
                                           : foot_in_b(view, view.support_a(c.i, n));
    c.gap.gap = std::max(c.gap.gap, -foot.distance);
    return foot.inside;
}

}  // namespace

void check_depths(const PairView& view, std::vector<Candidate>& candidates) {
    // In 3D only (docs/method.md, section 3); of two convex solids the separating axis tells the
    // depth.
    if (view.shape_a.dimension == 2 || is_convex_pair(view)) return;
    const double slack = deep_slack(view);
    std::erase_if(candidates,
                  [&](Candidate& c) { return c.gap.gap < -slack && !hold_to_meshes(view, c); });
}

}  // namespace ice
