// SPDX-License-Identifier: GPL-3.0-or-later
// Patterns "grid" and "brick": equal rectangles, as sawn in model tests.
#include "common/base/error.hpp"
#include "preprocess/field/plan_floes.hpp"

namespace ice {

FieldPlan plan_grid(const FieldSpec& s) {
    const auto [columns, rows] = s.count;
    const double length = s.floe_size[0], breadth = s.floe_size[1];
    if (static_cast<double>(columns) * rows > kMostFloes)
        throw bad_input("floes.count", "needs more than a million floes", "use fewer");
    // the field is centred about y = origin; x counts from its leading edge
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
    // Brick: every other column begins and ends with half a floe. Two halves and one gap take the
    // room of a whole floe, so all columns have the same breadth.
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

}  // namespace ice
