// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/sweep/sweep_markdown.hpp"

#include <algorithm>
#include <cmath>

#include "postprocess/sweep/split_sweep.hpp"
#include "postprocess/sweep/sweep_charts.hpp"
#include "postprocess/sweep/sweep_columns.hpp"

namespace ice::sweep {

namespace {

// a table's bar would end the cell
std::string plain(std::string text) {
    for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2)
        // two characters on: the bar itself is not found again
        text.insert(at, "\\");
    return text;
}

std::string table_text(const std::vector<Column>& columns) {
    // all columns have as many cells: they are made from the same points
    std::string out = "|", rule = "|";
    for (const Column& column : columns) {
        out += " " + plain(column.title) + " |";
        rule += "---|";
    }
    out += "\n" + rule + "\n";
    for (std::size_t row = 0; row < columns.front().cells.size(); ++row) {
        out += "|";
        for (const Column& column : columns) out += " " + plain(column.cells[row]) + " |";
        out += "\n";
    }
    return out;
}

// What "(n = 2, t = 12.7)" means, below the table where it stands.
std::string footnote(const std::vector<Point>& points) {
    const bool two = std::any_of(points.begin(), points.end(), [](const Point& p) {
        return p.runs.size() == 2 && std::isfinite(p.part(Part::total).half);
    });
    return two ? "\nn = 2, t = 12.7: a 95 % interval of two runs is 12.7 standard errors of their "
                 "mean (Student's t), which says little about it; of three runs it is 4.3, of ten "
                 "2.3.\n"
               : "";
}

std::vector<Column> joined(std::vector<Column> columns, const std::vector<Column>& more) {
    columns.insert(columns.end(), more.begin(), more.end());
    return columns;
}

// One table of forces and one of work: Markdown has no groups of columns, and a row of both would
// not fit a page.
std::string tables(const Sweep& sweep) {
    const auto points = make_points(sweep);
    if (points.empty()) return "";
    const report::ForceUnit unit = choose_sweep_unit(points);
    const auto axes = axis_columns(sweep, points, false);
    Column runs{"runs", {}};
    for (const Point& point : points) runs.cells.push_back(std::to_string(point.runs.size()));
    // Without intervals of the parts: in text each would double its column. The total has its own.
    const auto forces = force_columns(points, unit,
                                      {{Part::bow_contact, "bow"},
                                       {Part::sides_contact, "sides"},
                                       {Part::bottom_contact, "bottom"},
                                       {Part::rest_contact, "rest"},
                                       {Part::friction, "friction"}},
                                      false);
    const auto work = work_columns(sweep, points, unit);
    return table_text(joined(joined(axes, {runs}), forces)) + footnote(points) +
           (work.empty() ? "" : "\n" + table_text(joined(axes, work)));
}

}  // namespace

std::string sweep_markdown(const Sweep& sweep) {
    std::string out;
    // Runs in 2D and 3D have different units and are never in one table.
    for (const Sweep& part : split_sweep(sweep)) {
        const std::string text = tables(part);
        out += (out.empty() || text.empty() ? "" : "\n") + text;
    }
    return out;
}

}  // namespace ice::sweep
