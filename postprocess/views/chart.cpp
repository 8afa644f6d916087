// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/views/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
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

std::string dash_attribute(const std::string& dash) {
    return dash.empty() ? "" : fmt::format(" stroke-dasharray=\"{}\"", dash);
}

// one row of samples and names above the plot; rough text widths are enough to place them
std::string draw_legend(const Chart& chart, double x, double y) {
    std::string out;
    const auto add = [&](const std::string& name, const std::string& color,
                         const std::string& dash) {
        out += line_element(
            x, y - 4.0, x + 20.0, y - 4.0,
            fmt::format("stroke=\"{}\" stroke-width=\"2.5\"{}", color, dash_attribute(dash)));
        out += text_element(x + 25.0, y, name, "start");
        x += 25.0 + 7.0 * static_cast<double>(name.size()) + 16.0;
    };
    for (const Curve& curve : chart.curves)
        if (!curve.name.empty()) add(curve.name, curve.color, curve.dash);
    if (chart.level) add(chart.level_name, kBlack, "6 4");
    return out;
}

std::string draw_curve(const Curve& curve, const Axis& x, const Axis& y) {
    std::vector<Vec2> points;
    points.reserve(curve.points.size());
    for (const Vec2& p : curve.points) points.emplace_back(x.pixel(p.x()), y.pixel(p.y()));
    const std::string data = path_data(points, false);
    if (data.empty()) return "";
    return fmt::format(
        "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" "
        "stroke-linejoin=\"round\"{}{}/>\n",
        data, curve.color, curve.width, dash_attribute(curve.dash),
        curve.opacity < 1.0 ? fmt::format(" opacity=\"{}\"", curve.opacity) : "");
}

}  // namespace

std::string draw_chart(const Chart& chart) {
    Range xs, ys;
    for (const Curve& curve : chart.curves)
        for (const Vec2& p : curve.points) {
            xs.add(p.x());
            ys.add(p.y());
        }
    std::string out = svg_open(chart.width, chart.height, chart.title);
    out += text_element(8.0, 16.0, chart.title, "start", "font-weight=\"600\"");
    if (!(xs.low <= xs.high))
        return out + text_element(0.5 * chart.width, 0.5 * chart.height, "no data", "middle") +
               "</svg>\n";
    if (chart.y_range) ys = {chart.y_range->first, chart.y_range->second};
    ys.add(0.0);
    if (chart.level) ys.add(*chart.level);
    widen(ys.low, ys.high);
    if (!(xs.high > xs.low)) xs.high = xs.low + 1.0;
    // a history begins one step after 0: the axis begins at 0
    if (xs.low > 0.0 && xs.low < 0.02 * xs.high) xs.low = 0.0;

    const Axis x{xs.low, xs.high, 68.0, chart.width - 12.0};
    const Axis y{ys.low, ys.high, chart.height - 42.0, 46.0};
    if (chart.averaged) {
        const double from = std::clamp(x.pixel(chart.averaged->first), x.from, x.to);
        const double to = std::clamp(x.pixel(chart.averaged->second), x.from, x.to);
        out +=
            fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"#f1f5f8\"/>\n",
                        pixels(from), pixels(y.to), pixels(to - from), pixels(y.from - y.to));
    }
    out += draw_axes(x, y, chart.x_title, chart.y_title);
    out += line_element(x.from, y.pixel(0.0), x.to, y.pixel(0.0), "stroke=\"#8a949c\"");
    // the inner svg cuts off what reaches out of the plot area
    const double wide = x.to - x.from, tall = y.from - y.to;
    out += fmt::format(
        "<svg x=\"{0}\" y=\"{1}\" width=\"{2}\" height=\"{3}\" viewBox=\"{0} {1} {2} {3}\">\n",
        pixels(x.from), pixels(y.to), pixels(wide), pixels(tall));
    for (const Curve& curve : chart.curves) out += draw_curve(curve, x, y);
    out += "</svg>\n";
    if (chart.level)
        out += line_element(x.from, y.pixel(*chart.level), x.to, y.pixel(*chart.level),
                            "stroke=\"#222222\" stroke-width=\"1.5\" stroke-dasharray=\"6 4\"");
    out += draw_legend(chart, x.from, 36.0);
    return out + "</svg>\n";
}

}  // namespace ice::views
