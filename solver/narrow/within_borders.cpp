// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/within_borders.hpp"

#include <algorithm>

#include "solver/narrow/gap_rule.hpp"

namespace ice {

namespace {

double slack_of(const Shape& shape, std::int32_t sphere, const Gap& gap) {
    return kBeyond * shape.radius[sphere] + std::max(gap.gap, 0.0);
}

// Is the point, in a's axes, on what a's or b's sphere stands for?
bool a_holds(const PairView& view, std::int32_t i, const Gap& gap, const Vec3& point) {
    return view.shape_a.borders.hold(i, point, slack_of(view.shape_a, i, gap));
}
bool b_holds(const PairView& view, std::int32_t j, const Gap& gap, const Vec3& point) {
    return view.shape_b.borders.hold(j, view.to_b(point), slack_of(view.shape_b, j, gap));
}

bool edges_hold(const PairView& view, std::int32_t i, std::int32_t j, const Gap& gap) {
    const Vec3 point_a = view.support_a(i, gap.normal), point_b = view.support_b(j, -gap.normal);
    const Vec3 edge_a = view.shape_a.faces[i].edge(gap.edge_a);
    const Vec3 edge_b = view.turn * view.shape_b.faces[j].edge(gap.edge_b);
    const Crossing at = find_crossing(point_a, edge_a, point_b, edge_b);
    return (!view.shape_a.borders.has(i) || a_holds(view, i, gap, point_a + at.along_a * edge_a)) &&
           (!view.shape_b.borders.has(j) || b_holds(view, j, gap, point_b + at.along_b * edge_b));
}

}  // namespace

bool is_within_borders(const PairView& view, std::int32_t i, std::int32_t j, const Gap& gap) {
    if (gap.crossing) {
        if (!view.shape_a.borders.has(i) && !view.shape_b.borders.has(j)) return true;
        return edges_hold(view, i, j, gap);
    }
    // the probe's point itself where it is inside, else below it on the face
    const Vec3 rise = std::max(gap.gap, 0.0) * gap.normal;
    if (gap.a_is_surface)
        return !view.shape_a.borders.has(i) ||
               a_holds(view, i, gap, view.support_b(j, -gap.normal) - rise);
    return !view.shape_b.borders.has(j) ||
           b_holds(view, j, gap, view.support_a(i, gap.normal) + rise);
}

}  // namespace ice
