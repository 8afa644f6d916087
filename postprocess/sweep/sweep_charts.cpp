// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/sweep/sweep_charts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "postprocess/sweep/formula_curves.hpp"
#include "postprocess/sweep/key_names.hpp"
#include "postprocess/views/axis.hpp"
#include "postprocess/views/chart.hpp"

namespace ice::sweep {

using views::Vec2;

namespace {

const std::vector<std::string> kColors{views::kBlue, views::kOrange, views::kGreen, views::kPurple,
                                       views::kBlack};
// One mark per colour, so that curves differ in prints without colour, too. More curves than
// colours have no overview: they could not be distinguished.
constexpr char kMarks[] = {'o', 's', '^', 'd', 'v'};
constexpr const char* kFormulaDash = "2 3";
constexpr const char* kTwoRunsDash = "3 2";

struct Style {
    std::string name, color, dash;
    double width = 1.8;
    char mark = 0;
};

// Draws points of several curves into one chart, in the chart's unit.
class Plotter {
public:
    Plotter(const Sweep& sweep, const std::vector<Curve>& curves, const report::ForceUnit& unit)
        : sweep_(sweep), unit_(unit) {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const Curve& curve : curves)
            for (const Point& point : curve.points) {
                low = std::min(low, point.x(sweep));
                high = std::max(high, point.x(sweep));
            }
        // half a cap: 0.8 % of the axis; a single place has no axis and takes 0.8 % of its own
        // value
        cap_ = high > low ? 0.008 * (high - low) : 0.008 * std::max(std::abs(high), 1.0);
        ends_ = {low, high};
        // an axis that would hold nothing in its first half does not begin at 0
        from_zero_ = low >= 0.0 && (sweep.x == kSpeedKey || low <= 0.5 * high);
    }

    // names and scales of the x axis; invisible ends, so that all charts have the same one
    void set_axis(views::Chart& chart) const {
        chart.x_title = axis_title(sweep_.x);
        chart.x_from_zero = from_zero_;
        if (sweep_.x == kSpeedKey) chart.top_scale = {1.0 / kKnot, "speed [kn]"};
        views::Curve ends{"", "none", {}, 0.0, "", 1.0};
        ends.points = {Vec2(from_zero_ ? 0.0 : ends_.first - 2.0 * cap_, 0.0),
                       Vec2(ends_.second + 2.0 * cap_, 0.0)};
        chart.curves.push_back(ends);
    }

    // a line of the legend that explains the dashed bars of two runs, where there are any
    void add_note(views::Chart& chart) const {
        if (two_runs_)
            chart.curves.push_back({"two runs: t = 12.7", "#777777", {}, 1.2, kTwoRunsDash, 1.0});
    }

    // `value` gives the Estimate of a point
    template <class Value>
    void add(views::Chart& chart, const Curve& curve, const Style& style, const Value& value) {
        views::Curve line{style.name, style.color, {}, style.width, style.dash, 1.0, style.mark};
        std::vector<views::Curve> marks;
        for (const Point& point : curve.points) {
            const Estimate estimate = value(point);
            if (!std::isfinite(estimate.mean)) continue;
            const double x = point.x(sweep_), y = estimate.mean / unit_.newtons;
            line.points.emplace_back(x, y);
            // Two runs have an interval of t = 12.7 standard errors, which is too wide to be of
            // use: its bar is dashed.
            if (!std::isfinite(estimate.half)) continue;
            marks.push_back(interval(x, y, estimate.half / unit_.newtons, style.color));
            if (point.runs.size() != 2) continue;
            marks.back().dash = kTwoRunsDash;
            two_runs_ = true;
        }
        if (line.points.empty()) return;
        chart.curves.push_back(std::move(line));
        chart.curves.insert(chart.curves.end(), marks.begin(), marks.end());
    }

    // the band between the lowest and the highest formula, where there are two or more
    void add_band(views::Chart& chart, const Curve& curve, const std::string& name) const {
        views::Curve area{name, "#b8c4cc", {}, 0.0, "", 0.45};
        area.filled = true;
        std::vector<Vec2> back;
        for (const Point& point : curve.points) {
            const auto band = formula_band(point);
            if (!band || !(band->high > band->low)) continue;
            area.points.emplace_back(point.x(sweep_), band->high / unit_.newtons);
            back.emplace_back(point.x(sweep_), band->low / unit_.newtons);
        }
        // upper edge forwards, lower edge back: one closed area
        if (area.points.size() < 2) return;
        area.points.insert(area.points.end(), back.rbegin(), back.rend());
        chart.curves.insert(chart.curves.begin(), area);
    }

private:
    // an I: lower cap, stem, upper cap as one line
    views::Curve interval(double x, double y, double half, const std::string& color) const {
        const double low = y - half, high = y + half;
        return {"",
                color,
                {Vec2(x - cap_, low), Vec2(x + cap_, low), Vec2(x, low), Vec2(x, high),
                 Vec2(x - cap_, high), Vec2(x + cap_, high)},
                1.2,
                "",
                1.0};
    }

    const Sweep& sweep_;
    const report::ForceUnit& unit_;
    double cap_ = 0.0;
    std::pair<double, double> ends_;
    bool from_zero_ = false, two_runs_ = false;
};

auto value_of(const FormulaCurve& drawn) {
    return [drawn](const Point& p) { return Estimate{value_at(p, drawn), std::nan("")}; };
}

// Parts that nothing ever touches are not drawn.
bool has_force(const Curve& curve, Part part) {
    return std::any_of(curve.points.begin(), curve.points.end(), [&](const Point& point) {
        return std::isfinite(point.part(part).mean) && point.part(part).mean != 0.0;
    });
}

// One range for all charts, so that they can be compared. Two seeds that disagree have an interval
// many times the mean, which would flatten every curve: it is cut at one span of the means beyond
// them.
std::pair<double, double> common_range(const std::vector<Curve>& curves,
                                       const std::vector<Part>& parts,
                                       const report::ForceUnit& unit) {
    double low = 0.0, high = 0.0, low_bar = 0.0, high_bar = 0.0;
    const auto add = [&](double mean, double half) {
        if (!std::isfinite(mean)) return;
        const double reach = std::isfinite(half) ? half : 0.0;
        low = std::min(low, mean / unit.newtons);
        high = std::max(high, mean / unit.newtons);
        low_bar = std::min(low_bar, (mean - reach) / unit.newtons);
        high_bar = std::max(high_bar, (mean + reach) / unit.newtons);
    };
    for (const Curve& curve : curves)
        for (const Point& point : curve.points) {
            for (const Part part : parts) add(point.part(part).mean, point.part(part).half);
            if (const auto band = formula_band(point)) {
                add(band->low, std::nan(""));
                add(band->high, std::nan(""));
            }
        }
    // no bar reaches farther beyond the means than the means are apart
    const double span = high - low;
    low = std::max(low_bar, low - span);
    high = std::min(high_bar, high + span);
    views::widen(low, high);
    return {low, high};
}

// The only axis beside x; "" when there are none or several.
std::string other_axis(const Sweep& sweep) {
    if (sweep.axes.size() != 2) return "";
    return sweep.axes[0] == sweep.x ? sweep.axes[1] : sweep.axes[0];
}

// Names in the overview's legend: labels, or shorter names where these are too long for one row:
// the values of the only other axis, whose name is in the title, or letters.
std::vector<std::string> name_curves(const Sweep& sweep, const std::vector<Curve>& curves,
                                     bool& valued) {
    // Letters of a legend [-] that fit one row of a chart 860 px wide, names with their samples.
    // Longer names would take a row for each curve and shrink the plot.
    constexpr std::size_t kMostLetters = 75;
    std::vector<std::string> names;
    std::size_t length = 0;
    for (const Curve& curve : curves) length += curve.label.size() + 6;
    const std::string axis = other_axis(sweep);
    // short names only if they differ
    std::set<std::string> values;
    if (!axis.empty() && length > kMostLetters)
        for (const Curve& curve : curves)
            values.insert(short_text(curve.points.front().at.at(axis)));
    valued = !curves.empty() && values.size() == curves.size();  // files may share a name
    if (valued) {
        for (const Curve& curve : curves)
            names.push_back(short_text(curve.points.front().at.at(axis)));
        return names;
    }
    for (std::size_t k = 0; k < curves.size(); ++k) {
        const bool lettered = length > kMostLetters && curves.size() <= kColors.size();
        names.push_back(lettered ? std::string(1, static_cast<char>('A' + k)) : curves[k].label);
    }
    return names;
}

}  // namespace

report::ForceUnit choose_sweep_unit(const std::vector<Point>& points) {
    double largest = 0.0;
    for (const Point& point : points)
        if (std::isfinite(point.part(Part::total).mean))
            largest = std::max(largest, std::abs(point.part(Part::total).mean));
    return report::choose_unit(largest, points.empty() ? 3 : points.front().dimension);
}

std::string draw_overview(const Sweep& sweep, const std::vector<Curve>& curves,
                          const report::ForceUnit& unit, double width) {
    if (sweep.x.empty() || curves.empty() || curves.size() > kColors.size()) return "";
    views::Chart chart;
    chart.title = "Resistance";
    chart.y_title = "resistance [" + unit.name + "]";
    chart.width = width;
    chart.height = 400.0;
    chart.y_range = common_range(curves, {Part::total}, unit);
    bool valued = false;
    const std::vector<std::string> names = name_curves(sweep, curves, valued);
    if (valued) chart.title = "Resistance by " + axis_title(other_axis(sweep));
    Plotter plotter(sweep, curves, unit);
    plotter.set_axis(chart);
    const auto formulas = comparable_curves(curves);
    if (curves.size() == 1) plotter.add_band(chart, curves[0], "formulas");
    for (std::size_t k = 0; k < curves.size(); ++k) {
        const std::string name = names[k].empty() ? "computed" : names[k];
        plotter.add(chart, curves[k], {name, kColors[k], "", 2.2, kMarks[k]},
                    [](const Point& p) { return p.part(Part::total); });
        // Of one curve the formulas are named; of several they have the curves' colours, and
        // their dashes are explained once, below.
        for (const FormulaCurve& f : formulas)
            plotter.add(chart, curves[k],
                        {curves.size() == 1 ? f.legend : "", kColors[k], f.dash, 1.8}, value_of(f));
    }
    if (curves.size() > 1)
        for (const FormulaCurve& f : formulas)
            chart.curves.push_back({f.legend, views::kBlack, {}, 1.8, f.dash, 1.0});
    plotter.add_note(chart);
    return draw_chart(chart);
}

std::string draw_peaks(const Sweep& sweep, const std::vector<Curve>& curves, double width) {
    if (sweep.x.empty() || curves.empty() || curves.size() > kColors.size()) return "";
    double largest = 0.0;
    for (const Curve& curve : curves)
        for (const Point& point : curve.points)
            if (std::isfinite(point.largest)) largest = std::max(largest, std::abs(point.largest));
    if (!(largest > 0.0)) return "";
    // One unit for all curves of the chart, by its largest value.
    const auto unit = report::choose_unit(largest, curves.front().points.front().dimension);
    views::Chart chart;
    chart.title = "Largest resistance in a step";
    chart.y_title = "resistance [" + unit.name + "]";
    chart.width = width;
    chart.height = 340.0;
    // 5 % above the largest value, for its mark
    chart.y_range = {0.0, 1.05 * largest / unit.newtons};
    bool valued = false;
    const std::vector<std::string> names = name_curves(sweep, curves, valued);
    Plotter plotter(sweep, curves, unit);
    plotter.set_axis(chart);
    for (std::size_t k = 0; k < curves.size(); ++k) {
        const std::string name = names[k].empty() ? "" : names[k] + ": ";
        plotter.add(chart, curves[k],
                    {name + "largest of all runs", kColors[k], "", 2.0, kMarks[k]},
                    [](const Point& p) {
                        return Estimate{p.largest, std::nan("")};
                    });
        plotter.add(chart, curves[k], {name + "mean of the runs' largest", kColors[k], "6 3", 1.6},
                    [](const Point& p) {
                        return Estimate{p.peak.mean, std::nan("")};
                    });
        plotter.add(chart, curves[k], {name + "mean", kColors[k], kFormulaDash, 1.6},
                    [](const Point& p) {
                        return Estimate{p.part(Part::total).mean, std::nan("")};
                    });
    }
    return draw_chart(chart);
}

namespace {

using PartStyles = std::vector<std::pair<Part, Style>>;

constexpr const char* kBreakingColor = "#8c564b";

// Level ice has breaking and submersion, which are the parts of the formulas as well; with the
// regions of the hull a small chart would have a dozen curves, so that those are in the table.
const PartStyles& styles_of(bool level_ice) {
    static const PartStyles kBroken{
        {Part::total, {"resistance", views::kBlack, "", 2.4, 'x'}},
        {Part::bow_contact, {"bow", views::kBlue, "", 1.8, 'o'}},
        {Part::sides_contact, {"sides", views::kGreen, "", 1.8, 's'}},
        {Part::bottom_contact, {"bottom", views::kOrange, "", 1.8, '^'}},
        {Part::rest_contact, {"rest", views::kPurple, "", 1.8, 'd'}},
        {Part::friction, {"friction", "#777777", "6 3", 1.8}}};
    static const PartStyles kLevel{
        {Part::total, {"resistance", views::kBlack, "", 2.4, 'x'}},
        {Part::breaking, {"breaking", kBreakingColor, "", 2.0, 's'}},
        {Part::submersion, {"submersion and all else", views::kBlue, "", 2.0, 'o'}}};
    return level_ice ? kLevel : kBroken;
}

// The formulas' totals compare with the resistance, their components with single parts, so the band
// is of the totals alone. In level ice the overview has the totals, and components have the colour
// of the run's part that they compare with.
void add_formulas(Plotter& plotter, const Curve& curve, views::Chart& chart) {
    const bool level = curve.points.front().level_ice;
    plotter.add_band(chart, curve, level ? "formulas, total" : "formulas");
    if (!level)
        for (const FormulaCurve& f : comparable_curves({curve}))
            plotter.add(chart, curve, {f.legend, views::kBlack, f.dash, 1.8}, value_of(f));
    for (const FormulaCurve& f : component_curves(curve))
        plotter.add(chart, curve,
                    {f.legend, level ? kBreakingColor : views::kBlack, f.dash, level ? 1.6 : 1.2},
                    value_of(f));
    for (const FormulaCurve& f : broken_curves(curve))
        plotter.add(chart, curve, {f.legend, views::kBlue, f.dash, 1.6}, value_of(f));
}

}  // namespace

std::vector<std::string> draw_parts(const Sweep& sweep, const std::vector<Curve>& curves,
                                    const report::ForceUnit& unit, double width) {
    std::vector<std::string> charts;
    if (sweep.x.empty()) return charts;
    Plotter plotter(sweep, curves, unit);
    std::vector<Part> parts;
    for (const Curve& curve : curves)
        for (const auto& [part, style] : styles_of(curve.points.front().level_ice))
            parts.push_back(part);
    bool valued = false;
    const std::vector<std::string> names = name_curves(sweep, curves, valued);
    for (std::size_t k = 0; k < curves.size(); ++k) {
        const Curve& curve = curves[k];
        views::Chart chart;
        chart.title = curve.label.empty() ? "Parts of the resistance" : curve.label;
        if (!valued && names[k] != curve.label) chart.title = names[k] + ": " + curve.label;
        chart.y_title = "resistance [" + unit.name + "]";
        chart.width = width;
        chart.height = 380.0;
        chart.y_range = common_range(curves, parts, unit);
        plotter.set_axis(chart);
        // parts without a force have no curve
        for (const auto& [part, style] : styles_of(curve.points.front().level_ice))
            if (has_force(curve, part))
                plotter.add(chart, curve, style,
                            [part = part](const Point& p) { return p.part(part); });
        add_formulas(plotter, curve, chart);
        plotter.add_note(chart);
        charts.push_back(draw_chart(chart));
    }
    return charts;
}

}  // namespace ice::sweep
