// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/sweep/sweep_markdown.hpp"

#include <algorithm>

#include "postprocess/sweep/key_names.hpp"
#include "postprocess/sweep/share_work.hpp"
#include "postprocess/sweep/sweep_charts.hpp"
#include "postprocess/sweep/sweep_tables.hpp"

namespace ice::sweep {

namespace {

struct Column {
    std::string title;
    std::vector<std::string> cells;  // a row each
};

// a table's bar would end the cell
std::string plain(std::string text) {
    for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2)
        text.insert(at, "\\");
    return text;
}

// no digit but 0: zero, or "n/a"
bool says_something(const std::string& cell) {
    return cell.find_first_of("123456789") != std::string::npos;
}

std::vector<Column> axis_columns(const Sweep& sweep, const std::vector<Point>& points) {
    std::vector<Column> columns;
    for (const std::string& axis : sweep.axes) {
        columns.push_back({axis_title(axis), {}});
        for (const Point& point : points)
            columns.back().cells.push_back(short_text(point.at.at(axis)));
    }
    return columns;
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

std::string table_text(const std::vector<Column>& columns) {
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

std::string force_text(const Sweep& sweep, const std::vector<Point>& points,
                       const report::ForceUnit& unit) {
    static constexpr std::pair<Part, const char*> kParts[]{{Part::bow_contact, "bow"},
                                                           {Part::sides_contact, "sides"},
                                                           {Part::bottom_contact, "bottom"},
                                                           {Part::rest_contact, "rest"},
                                                           {Part::friction, "friction"}};
    std::vector<Column> columns = axis_columns(sweep, points);
    columns.push_back({"runs", {}});
    columns.push_back({"resistance [" + unit.name + "]", {}});
    const std::size_t first = columns.size();
    for (const auto& [part, title] : kParts) columns.push_back({title, {}});
    columns.push_back({"Lindqvist", {}});
    for (const Point& point : points) {
        columns[first - 2].cells.push_back(std::to_string(point.runs.size()));
        columns[first - 1].cells.push_back(with_interval(unit, point.part(Part::total)));
        for (std::size_t k = 0; k < std::size(kParts); ++k)
            columns[first + k].cells.push_back(unit.text(point.part(kParts[k].first).mean));
        columns.back().cells.push_back(unit.text(point.lindqvist));
    }
    drop_empty(columns, first);
    return table_text(columns);
}

std::string work_text(const Sweep& sweep, const std::vector<Point>& points,
                      const report::ForceUnit& unit) {
    std::vector<Column> columns = axis_columns(sweep, points);
    const std::size_t first = columns.size();
    for (const auto& [title, force] : share_work(sweep, points.front()))
        columns.push_back({title, {}});
    columns[first].title += " [" + unit.name + "]";
    for (const Point& point : points) {
        std::size_t k = first;
        for (const auto& [title, force] : share_work(sweep, point))
            columns[k++].cells.push_back(unit.text(force));
    }
    drop_empty(columns, first);
    return columns.size() == first ? "" : table_text(columns);
}

}  // namespace

std::string sweep_markdown(const Sweep& sweep) {
    const auto points = make_points(sweep);
    if (points.empty()) return "";
    const report::ForceUnit unit = choose_sweep_unit(points);
    const std::string work = work_text(sweep, points, unit);
    return force_text(sweep, points, unit) + (work.empty() ? "" : "\n" + work);
}

}  // namespace ice::sweep
