// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "common/base/error.hpp"
#include "preprocess/field/plan_floes.hpp"

namespace ice {

namespace {

Outline rectangle(double x, double y, double length, double breadth) {
    return {{x, y}, {x + length, y}, {x + length, y + breadth}, {x, y + breadth}};
}

}  // namespace

FieldPlan plan_grid(const FieldSpec& s) {
    const auto [columns, rows] = s.count;
    const double length = s.floe_size[0], breadth = s.floe_size[1];
    if (static_cast<double>(columns) * rows > kMostFloes)
        throw bad_input("floes.count", "asks for more than a million floes", "use fewer");
    const double whole = rows * breadth + (rows - 1) * s.gap[1];
    const double low = s.origin[1] - 0.5 * whole;
    const auto x_of = [&](int column) { return s.origin[0] + column * (length + s.gap[0]); };
    const auto y_of = [&](int row) { return low + row * (breadth + s.gap[1]); };
    FieldPlan plan;
    plan.area = Rectangle(Vec2(s.origin[0], low), Vec2(x_of(columns - 1) + length, low + whole));
    if (s.pattern == FieldPattern::grid) {
        for (int row = 0; row < rows; ++row)
            for (int column = 0; column < columns; ++column)
                plan.loose.push_back(rectangle(x_of(column), y_of(row), length, breadth));
        return plan;
    }
    const double half = 0.5 * (breadth - s.gap[1]);
    if (!(half > 0.0))
        throw bad_input("floes.gap", "leaves nothing of the half floes of a brick pattern",
                        "use a gap below the floes' breadth");
    for (int column = 0; column < columns; ++column) {
        const double x = x_of(column);
        if (column % 2 == 0) {
            for (int row = 0; row < rows; ++row)
                plan.loose.push_back(rectangle(x, y_of(row), length, breadth));
            continue;
        }
        plan.loose.push_back(rectangle(x, low, length, half));
        for (int row = 0; row + 1 < rows; ++row)
            plan.loose.push_back(rectangle(x, y_of(row) + half + s.gap[1], length, breadth));
        plan.loose.push_back(rectangle(x, low + whole - half, length, half));
    }
    return plan;
}

void add_edges(const FieldSpec& s, FieldPlan& plan) {
    if (s.edge_breadth == 0.0) return;
    const double first = plan.area.min().x() - s.edge_overhang[0];
    const double length = plan.area.max().x() + s.edge_overhang[1] - first;
    if (!(length > 0.0))
        throw bad_input("edges.overhang", "leaves nothing of the edges", "use larger numbers");
    const double count = std::max(1.0, std::ceil(length / s.edge_piece - 1e-9));
    if (count > kMostFloes)
        throw bad_input("edges.piece", "asks for more than a million pieces", "use longer ones");
    const int pieces = static_cast<int>(count);
    for (const double y :
         {plan.area.min().y() - s.edge_gap - s.edge_breadth, plan.area.max().y() + s.edge_gap})
        for (int k = 0; k < pieces; ++k)
            plan.fixed.push_back(
                rectangle(first + k * length / pieces, y, length / pieces, s.edge_breadth));
}

}  // namespace ice
