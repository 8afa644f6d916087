// SPDX-License-Identifier: GPL-3.0-or-later
// Unbroken ice around a field, of any pattern: both sides of the channel and its far end.
#include <cmath>

#include "common/base/error.hpp"
#include "preprocess/field/plan_floes.hpp"

namespace ice {

namespace {

// Equal pieces of at most edges.piece that make up `length`.
int pieces_of(const FieldSpec& s, double length) {
    // 1e-9: a length that is a multiple of the piece takes no piece more
    const double count = std::max(1.0, std::ceil(length / s.edge_piece - 1e-9));
    if (count > kMostFloes)
        throw bad_input("edges.piece", "needs more than a million pieces", "use longer ones");
    return static_cast<int>(count);
}

// The largest x of any floe: a row of cusps or a polygon may reach beyond the field's area.
double far_end(const FieldPlan& plan) {
    double x = plan.area.max().x();
    for (const Outline& floe : plan.loose)
        for (const Vec2& corner : floe) x = std::max(x, corner.x());
    return x;
}

}  // namespace

void add_edges(const FieldSpec& s, FieldPlan& plan) {
    if (s.edge_breadth == 0.0) return;
    const double low = plan.area.min().y() - s.edge_gap, high = plan.area.max().y() + s.edge_gap;
    const double first = plan.area.min().x() - s.edge_overhang[0];
    double last = plan.area.max().x() + s.edge_overhang[1];
    const double end = far_end(plan) + s.edge_gap;  // where the ice ahead begins
    // the sides go on beside the ice ahead, or floes would leave between them
    if (s.edge_ahead > 0.0) last = std::max(last, end + s.edge_ahead);
    const double length = last - first;
    if (!(length > 0.0))
        throw bad_input("edges.overhang", "leaves nothing of the edges", "use larger numbers");
    const int pieces = pieces_of(s, length);
    for (const double y : {low - s.edge_breadth, high})
        for (int k = 0; k < pieces; ++k)
            plan.fixed.push_back(
                rectangle(first + k * length / pieces, y, length / pieces, s.edge_breadth));
    if (s.edge_ahead == 0.0) return;
    const int across = pieces_of(s, high - low);
    for (int k = 0; k < across; ++k)
        plan.fixed.push_back(
            rectangle(end, low + k * (high - low) / across, s.edge_ahead, (high - low) / across));
}

}  // namespace ice
