// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/sweep/sweep_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/base/assert.hpp"
#include "postprocess/sweep/formula_curves.hpp"
#include "postprocess/sweep/key_names.hpp"
#include "postprocess/sweep/share_work.hpp"

namespace ice::sweep {

namespace {

// no digit but 0: zero, or "n/a"
bool says_something(const std::string& cell) {
    return cell.find_first_of("123456789") != std::string::npos;
}

void drop_empty(std::vector<Column>& columns, std::size_t first) {
    const auto begin = columns.begin() + static_cast<std::ptrdiff_t>(first);
    columns.erase(std::remove_if(begin, columns.end(),
                                 [](const Column& column) {
                                     return std::none_of(column.cells.begin(), column.cells.end(),
                                                         says_something);
                                 }),
                  columns.end());
}

}  // namespace

std::string with_interval(const report::ForceUnit& unit, const Estimate& e, std::size_t runs) {
    if (!std::isfinite(e.half)) return unit.text(e.mean);
    return unit.text(e.mean) + " \u00b1 " + unit.text(e.half) +
           (runs == 2 ? " (n = 2, t = 12.7)" : "");
}

std::vector<Column> axis_columns(const Sweep& sweep, const std::vector<Point>& points, bool knots) {
    std::vector<Column> columns;
    for (const std::string& axis : sweep.axes) {
        columns.push_back({axis_title(axis), {}});
        for (const Point& point : points)
            columns.back().cells.push_back(short_text(point.at.at(axis)));
        // speeds of ships are known in knots, those of models in metres per second
        if (!knots || axis != kSpeedKey) continue;
        columns.push_back({"speed [kn]", {}});
        for (const Point& point : points) {
            const auto& speed = point.at.at(axis).number;
            columns.back().cells.push_back(speed ? fmt::format("{:.2f}", *speed / kKnot) : "-");
        }
    }
    return columns;
}

std::vector<Column> force_columns(const std::vector<Point>& points, const report::ForceUnit& unit,
                                  std::vector<std::pair<Part, std::string>> parts, bool intervals) {
    const std::string in = " [" + unit.name + "]";
    parts.insert(parts.end(), {{Part::breaking, "breaking"}, {Part::submersion, "submersion"}});
    // Order of the columns: resistance, its parts, largest, formulas, release rule. Cells are
    // filled by number, so names and cells must keep that order.
    std::vector<Column> columns{{"resistance" + in, {}}};
    for (const auto& [part, title] : parts) columns.push_back({title + in, {}});
    columns.push_back({"largest" + in, {}});
    const auto formulas = comparable_curves({{"", points}});
    for (const FormulaCurve& f : formulas) {
        // points in level and in broken ice compare with two parts of one formula
        const bool alone = std::count_if(formulas.begin(), formulas.end(), [&](const auto& other) {
                               return other.legend == f.legend;
                           }) == 1;
        columns.push_back({f.legend + (alone ? "" : ", " + f.part) + in, {}});
    }
    for (const Point& point : points) {
        columns.front().cells.push_back(
            with_interval(unit, point.part(Part::total), point.runs.size()));
        for (std::size_t k = 0; k < parts.size(); ++k) {
            const Estimate& estimate = point.part(parts[k].first);
            columns[k + 1].cells.push_back(intervals ? with_interval(unit, estimate)
                                                     : unit.text(estimate.mean));
        }
        columns[parts.size() + 1].cells.push_back(unit.text(point.largest));
        for (std::size_t k = 0; k < formulas.size(); ++k)
            columns[parts.size() + 2 + k].cells.push_back(
                unit.text(point.formula(formulas[k].name, formulas[k].part)));
    }
    // columns with nothing but zeros and unknowns are left out
    drop_empty(columns, 1);
    columns.push_back({"release rule", {}});
    for (const Point& point : points)
        columns.back().cells.push_back(point.hold.empty() ? "-" : point.hold);
    return columns;
}

std::vector<Column> crack_columns(const std::vector<Point>& points) {
    std::vector<Column> columns{
        {"crack to the load [m]", {}},
        {fmt::format("crack in characteristic lengths (ships: {})", kCracksPerLength), {}},
        {fmt::format("crack in thicknesses (ships: {})", kCracksPerThickness), {}},
        {"opening angle [\u00b0]", {}},
        {"channel [m]", {}}};
    const auto add = [&](std::size_t column, double value, int decimals) {
        columns[column].cells.push_back(
            std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals) : "-");
    };
    for (const Point& point : points) {
        const CrackParticulars c = point.cracks.value_or(CrackParticulars{});
        add(0, c.radius, 2);
        add(1, c.per_length(), 2);
        add(2, c.per_thickness(), 1);
        add(3, c.opening_deg, 0);
        add(4, c.channel_breadth, 1);
    }
    drop_empty(columns, 0);
    return columns;
}

std::vector<Column> work_columns(const Sweep& sweep, const std::vector<Point>& points,
                                 const report::ForceUnit& unit) {
    ICE_ASSERT(!points.empty());
    std::vector<Column> columns;
    // all points have the same entries, in the same order
    for (const auto& [title, force] : share_work(sweep, points.front()))
        columns.push_back({std::string(title) + " [" + unit.name + "]", {}});
    for (const Point& point : points) {
        std::size_t k = 0;
        for (const auto& [title, force] : share_work(sweep, point))
            columns[k++].cells.push_back(unit.text(force));
    }
    // entries of the ledger that no run of the sweep has
    drop_empty(columns, 0);
    return columns;
}

}  // namespace ice::sweep
