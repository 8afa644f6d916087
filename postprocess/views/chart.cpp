// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/views/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "postprocess/views/axis.hpp"

namespace ice::views {

namespace {

struct Range {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    void add(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
};

// Left end of the legend and height of its rows [px]: a line of 13 px text and a gap. Higher rows
// take the plot's room.
constexpr double kLegendLeft = 12.0, kRow = 18.0;
// The plot area is cut this much outside its frame [px]: half a mark of 4.2 px and a little more.
// With less a mark on the frame is cut, with more curves beyond the range show outside it.
constexpr double kBorder = 5.0;

std::string dash_attribute(const std::string& dash) {
    return dash.empty() ? "" : fmt::format(" stroke-dasharray=\"{}\"", dash);
}

// A sign of about 8 px at a place.
std::string draw_mark(char mark, const Vec2& at, const std::string& color) {
    // r: half the size [px]; all marks have about the same extent, so that none dominates
    const double x = at.x(), y = at.y(), r = 4.2;
    const std::string fill = fmt::format("fill=\"{}\"", color);
    if (mark == 'o')
        return fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\" {}/>", pixels(x), pixels(y),
                           pixels(r), fill);
    std::vector<Vec2> corners;
    if (mark == 's') corners = {{x - r, y - r}, {x + r, y - r}, {x + r, y + r}, {x - r, y + r}};
    if (mark == '^') corners = {{x - r, y + r}, {x, y - r}, {x + r, y + r}};
    if (mark == 'v') corners = {{x - r, y - r}, {x, y + r}, {x + r, y - r}};
    if (mark == 'd') corners = {{x - r, y}, {x, y - r}, {x + r, y}, {x, y + r}};
    if (!corners.empty()) return fmt::format("<path d=\"{}\" {}/>", path_data(corners, true), fill);
    return fmt::format("<path d=\"{}{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.8\"/>",
                       path_data({{x - r, y - r}, {x + r, y + r}}, false),
                       path_data({{x - r, y + r}, {x + r, y - r}}, false), color);
}

struct Key {
    std::string name, color, dash;
    double width = 2.5;
    char mark = 0;
};

std::vector<Key> list_keys(const Chart& chart) {
    std::vector<Key> keys;
    for (const Curve& curve : chart.curves)
        if (!curve.name.empty())
            keys.push_back({curve.name, curve.color, curve.dash,
                            curve.filled        ? 9.0
                            : curve.width > 0.0 ? 2.5
                                                : 0.0,
                            curve.mark});
    if (chart.level) keys.push_back({chart.level_name, kBlack, "6 4", 2.5, 0});
    return keys;
}

double key_width(const Key& key) { return 29.0 + text_width(key.name) + 14.0; }

// Rows of the legend: a row takes keys as long as they fit, in the order of the curves.
std::vector<std::vector<Key>> fill_rows(const std::vector<Key>& keys, double width) {
    std::vector<std::vector<Key>> rows;
    double left = 0.0;
    for (const Key& key : keys) {
        if (rows.empty() || left < key_width(key)) {
            rows.emplace_back();
            left = width;
        }
        rows.back().push_back(key);
        left -= key_width(key);
    }
    return rows;
}

std::string draw_legend(const std::vector<std::vector<Key>>& rows, double left, double y) {
    std::string out;
    for (const auto& row : rows) {
        // sample, mark and name of each key from the left; rows were filled by key_width() alike
        double x = left;
        for (const Key& key : row) {
            if (key.width > 0.0)
                out += line_element(x, y - 4.0, x + 24.0, y - 4.0,
                                    fmt::format("stroke=\"{}\" stroke-width=\"{}\"{}", key.color,
                                                key.width, dash_attribute(key.dash)));
            if (key.mark != 0) out += draw_mark(key.mark, {x + 12.0, y - 4.0}, key.color) + "\n";
            out += text_element(x + 29.0, y, key.name, "start");
            x += key_width(key);
        }
        y += kRow;
    }
    return out;
}

// ticks of the second scale, above the plot
std::string draw_top_scale(const Axis& x, double y, double factor, const std::string& title) {
    std::string out;
    const auto ticks =
        choose_ticks(factor * x.low, factor * x.high, static_cast<int>((x.to - x.from) / 70.0) + 1);
    const double step = ticks.size() > 1 ? ticks[1] - ticks[0] : 1.0;
    for (const double v : ticks) {
        const double at = x.pixel(v / factor);
        out += line_element(at, y, at, y - 5.0, "stroke=\"#8a949c\"");
        out += text_element(at, y - 9.0, tick_label(v, step), "middle");
    }
    return out + text_element(0.5 * (x.from + x.to), y - 26.0, title, "middle");
}

std::string draw_curve(const Curve& curve, const Axis& x, const Axis& y) {
    std::vector<Vec2> points;
    points.reserve(curve.points.size());
    for (const Vec2& p : curve.points) points.emplace_back(x.pixel(p.x()), y.pixel(p.y()));
    if (curve.filled)
        return fmt::format("<path d=\"{}\" fill=\"{}\" opacity=\"{}\"/>\n", path_data(points, true),
                           curve.color, curve.opacity);
    std::string marks;
    if (curve.mark != 0)
        for (const Vec2& p : points) marks += draw_mark(curve.mark, p, curve.color);
    // a width of 0 is a curve of marks alone, as for formulas at single points
    const std::string data = path_data(points, false);
    if (data.empty() || !(curve.width > 0.0)) return marks;
    return marks + fmt::format(
                       "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" "
                       "stroke-linejoin=\"round\"{}{}/>\n",
                       data, curve.color, curve.width, dash_attribute(curve.dash),
                       curve.opacity < 1.0 ? fmt::format(" opacity=\"{}\"", curve.opacity) : "");
}

// the same chart over the exponents of x
Chart over_exponents(Chart chart) {
    for (Curve& curve : chart.curves)
        for (Vec2& p : curve.points) p.x() = std::log10(p.x());
    return chart;
}

// The range of the axes: all points, zero, and the chart's own limits.
std::pair<Range, Range> find_ranges(const Chart& chart) {
    Range xs, ys;
    for (const Curve& curve : chart.curves)
        for (const Vec2& p : curve.points) {
            xs.add(p.x());
            ys.add(p.y());
        }
    // without a point there is no range
    if (!(xs.low <= xs.high)) return {xs, ys};
    if (chart.y_range) ys = {chart.y_range->first, chart.y_range->second};
    ys.add(0.0);
    if (chart.level) ys.add(*chart.level);
    widen(ys.low, ys.high);
    if (!(xs.high > xs.low)) xs.high = xs.low + 1.0;
    // 2 %: a step is below 2 % of any run that is worth a chart
    // a history begins one step after 0: the axis begins at 0
    if (xs.low > 0.0 && xs.low < 0.02 * xs.high) xs.low = 0.0;
    if (chart.x_from_zero) xs.add(0.0);
    if (chart.x_logarithmic) {
        xs.low = std::floor(xs.low);
        xs.high = std::max(std::ceil(xs.high), xs.low + 1.0);
    }
    return {xs, ys};
}

}  // namespace

std::string draw_chart(const Chart& given) {
    const Chart chart = given.x_logarithmic ? over_exponents(given) : given;
    std::string out = svg_open(chart.width, chart.height, chart.title);
    out += text_element(8.0, 16.0, chart.title, "start", "font-weight=\"600\"");
    auto [xs, ys] = find_ranges(chart);
    if (!(xs.low <= xs.high))
        return out + text_element(0.5 * chart.width, 0.5 * chart.height, "no data", "middle") +
               "</svg>\n";

    // the last label of a logarithmic axis is at its very end
    const double right = chart.width - (chart.x_logarithmic ? 30.0 : 14.0);
    const auto keys = fill_rows(list_keys(chart), right - kLegendLeft);
    const double legend = 22.0 + kRow * static_cast<double>(keys.size());
    const double top = legend + (chart.top_scale ? 48.0 : 8.0);
    const Axis y{ys.low, ys.high, chart.height - 42.0, top};
    // the y axis first: the width of its labels decides where the plot begins
    const Axis x{xs.low, xs.high, 34.0 + label_width(y), right, chart.x_logarithmic};
    if (chart.averaged) {
        const double from = std::clamp(x.pixel(chart.averaged->first), x.from, x.to);
        const double to = std::clamp(x.pixel(chart.averaged->second), x.from, x.to);
        out +=
            fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"#f1f5f8\"/>\n",
                        pixels(from), pixels(y.to), pixels(to - from), pixels(y.from - y.to));
    }
    out += draw_axes(x, y, chart.x_title, chart.y_title);
    if (chart.top_scale)
        out += draw_top_scale(x, y.to, chart.top_scale->first, chart.top_scale->second);
    out += line_element(x.from, y.pixel(0.0), x.to, y.pixel(0.0), "stroke=\"#8a949c\"");
    // The inner svg cuts off curves that leave the plot area, but not marks on its border. Cutting
    // the curves here instead would need new points at the border.
    const bool marks = std::any_of(chart.curves.begin(), chart.curves.end(),
                                   [](const Curve& curve) { return curve.mark != 0; });
    const double border = marks ? kBorder : 0.0;
    const double wide = x.to - x.from + 2.0 * border, tall = y.from - y.to + 2.0 * border;
    out += fmt::format(
        "<svg x=\"{0}\" y=\"{1}\" width=\"{2}\" height=\"{3}\" viewBox=\"{0} {1} {2} {3}\">\n",
        pixels(x.from - border), pixels(y.to - border), pixels(wide), pixels(tall));
    for (const Curve& curve : chart.curves) out += draw_curve(curve, x, y);
    out += "</svg>\n";
    if (chart.level)
        out += line_element(x.from, y.pixel(*chart.level), x.to, y.pixel(*chart.level),
                            "stroke=\"#222222\" stroke-width=\"1.5\" stroke-dasharray=\"6 4\"");
    return out + draw_legend(keys, kLegendLeft, 36.0) + "</svg>\n";
}

}  // namespace ice::views
