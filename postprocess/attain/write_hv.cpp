// SPDX-License-Identifier: GPL-3.0-or-later
// The study as chart, table, CSV and page.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "common/base/units.hpp"
#include "postprocess/attain/hv_curves.hpp"
#include "postprocess/report/page.hpp"
#include "postprocess/sweep/sweep_tables.hpp"
#include "postprocess/views/chart.hpp"

namespace ice::attain {

namespace {

using views::escape;
using views::Vec2;

// Widths of the chart [px]: the page's text, and a phone held upright. Larger ones leave the page,
// smaller ones leave less room between labels.
constexpr double kWide = 860.0, kPhone = 400.0;

const char* name_of(Source source) {
    switch (source) {
        case Source::prescribed_course:
            return "prescribed course";
        case Source::free_ship:
            return "free ship";
        case Source::formula:
            break;
    }
    return "formula";
}

const char* name_of(Reach reach) {
    switch (reach) {
        case Reach::within:
            return "within";
        case Reach::outside:
            return "outside the speeds that were run";
        case Reach::stuck:
            return "stuck";
        case Reach::beyond:
            break;
    }
    return "ice does not hold the ship";
}

std::string title_of(const HvCurve& curve) {
    return curve.thrust.empty() ? curve.name : curve.thrust + ": " + curve.name;
}

// RFC 4180: quotes around texts with a comma, a quote or a line break, quotes within doubled. Lines
// end in CR LF.
std::string csv_text(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string out = "\"";
    for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
    return out + "\"";
}

std::string csv_number(double value) {
    return std::isfinite(value) ? fmt::format("{}", value) : std::string();
}

// one colour for each thrust, black for free ships
std::string color_of(const HvStudy& study, const HvCurve& curve) {
    static const std::vector<std::string> kColors{views::kBlue, views::kOrange, views::kGreen,
                                                  views::kPurple};
    if (curve.thrust.empty()) return views::kBlack;
    std::vector<std::string> thrusts;
    for (const HvCurve& c : study.curves)
        if (!c.thrust.empty() &&
            std::find(thrusts.begin(), thrusts.end(), c.thrust) == thrusts.end())
            thrusts.push_back(c.thrust);
    const auto at = std::find(thrusts.begin(), thrusts.end(), curve.thrust) - thrusts.begin();
    return kColors[static_cast<std::size_t>(at) % kColors.size()];
}

// an I over the interval
views::Curve interval(const HvPoint& p, double cap, const std::string& color) {
    const double x = p.thickness, low = p.attained.low, high = p.attained.high;
    return {"",
            color,
            {Vec2(x - cap, low), Vec2(x + cap, low), Vec2(x, low), Vec2(x, high),
             Vec2(x - cap, high), Vec2(x + cap, high)},
            1.2,
            "",
            1.0};
}

std::string which_resistance(const HvStudy& study) {
    return study.level_ice
               ? "The resistance is that of level ice which the ship breaks."
               : "The resistance is that of ice which is broken already (pre-sawn, or a broken "
                 "channel): in level ice the ship is slower, as breaking needs thrust, too.";
}

std::string study_table(const HvStudy& study) {
    std::vector<std::vector<std::string>> rows;
    for (const HvCurve& curve : study.curves) {
        if (curve.source == Source::formula) continue;  // many points; the CSV has them
        for (const HvPoint& p : curve.points) {
            const AttainedSpeed& a = p.attained;
            const auto speed = [](double v) {
                return std::isfinite(v) ? fmt::format("{:.2f}", v) : std::string("-");
            };
            rows.push_back({title_of(curve), fmt::format("{:.3g}", p.thickness), speed(a.speed),
                            speed(a.speed / kKnot), speed(a.low) + " to " + speed(a.high),
                            name_of(a.reach)});
        }
    }
    return report::table(
        {"Curve", "Thickness [m]", "Speed [m/s]", "Speed [kn]", "95 % interval [m/s]", "Reached"},
        rows);
}

}  // namespace

std::string hv_csv(const HvStudy& study) {
    std::string out =
        "source,curve,thrust,thickness_m,speed,speed_low,speed_high,speed_kn,reach\r\n";
    for (const HvCurve& curve : study.curves)
        for (const HvPoint& p : curve.points) {
            const AttainedSpeed& a = p.attained;
            out += fmt::format("{},{},{},{},{},{},{},{},{}\r\n", name_of(curve.source),
                               csv_text(curve.name), csv_text(curve.thrust),
                               csv_number(p.thickness), csv_number(a.speed), csv_number(a.low),
                               csv_number(a.high), csv_number(a.speed / kKnot), name_of(a.reach));
        }
    return out;
}

std::string draw_hv(const HvStudy& study, double width) {
    // Formulas are dashed and runs are marked: they differ in prints without colour, too.
    static const std::vector<std::string> kDashes{"2 3", "7 3 2 3", "9 4", "4 2"};
    views::Chart chart;
    chart.title = "Attainable speed";
    chart.x_title = "ice thickness [m]";
    chart.y_title = "speed [m/s]";
    chart.width = width;
    chart.height = 420.0;
    double low = std::numeric_limits<double>::infinity(), high = -low, fastest = 0.0;
    for (const HvCurve& curve : study.curves)
        for (const HvPoint& p : curve.points) {
            low = std::min(low, p.thickness);
            high = std::max(high, p.thickness);
            // The scale is that of the runs.
            if (curve.source != Source::formula && std::isfinite(p.attained.speed))
                fastest = std::max(fastest, p.attained.speed);
        }
    // width of the interval's end strokes, in metres of ice thickness
    const double cap = high > low ? 0.008 * (high - low) : 0.008 * high;
    // from zero where that costs no more than half of the width
    chart.x_from_zero = low <= 0.5 * high || low == high;
    std::size_t formulas = 0;
    for (const HvCurve& curve : study.curves) {
        const bool formula = curve.source == Source::formula;
        const std::string color = color_of(study, curve);
        views::Curve line{title_of(curve), color, {}, formula ? 1.5 : 2.2, "", 1.0};
        if (formula) line.dash = kDashes[formulas++ % kDashes.size()];
        if (curve.source == Source::free_ship) line.mark = 'd';
        if (curve.source == Source::prescribed_course) line.mark = 'o';
        for (const HvPoint& p : curve.points)
            if (std::isfinite(p.attained.speed))
                line.points.emplace_back(p.thickness, p.attained.speed);
        // Intervals are curves without a name, so that the legend does not list them.
        chart.curves.push_back(line);
        for (const HvPoint& p : curve.points)
            if (std::isfinite(p.attained.low) && std::isfinite(p.attained.high))
                chart.curves.push_back(interval(p, cap, color));
    }
    // Formulas do not set the scale: some go to infinity in thin ice.
    // 40 % above the fastest run leave room for bars and for formulas that are near the runs
    if (fastest > 0.0) chart.y_range = {0.0, 1.4 * fastest};
    return draw_chart(chart);
}

std::string make_hv_page(const sweep::Sweep& sweep, const HvStudy& study) {
    std::string out = report::open_page(sweep.title) + "<header><div class=\"inner\">\n<h1>" +
                      escape(sweep.title) + "</h1>\n<p>Attainable speed against ice thickness. " +
                      which_resistance(study) + "</p>\n</div></header>\n<main>\n";
    // Before the chart: a warning may say that a part of a curve is extrapolated.
    if (!study.warnings.empty()) {
        out += "<section id=\"faults\" class=\"warnings\">\n<ul>\n";
        for (const std::string& text : study.warnings) out += "<li>" + escape(text) + "</li>\n";
        out += "</ul>\n</section>\n";
    }
    out += report::section(
        "hv", "Speed against thickness",
        "Prescribed course: the speed at which the thrust, net of open water, equals the "
        "resistance. "
        "The resistance is a line or a parabola through runs at given speeds; bars show where the "
        "thrust equals the ends of its 95 % interval. Free ship: mean speed of ships that the "
        "thrust drives. Formulas (dashed): the speed at which they equal the same thrust.",
        "<div class=\"both\"><div class=\"opening desk\">" + draw_hv(study, kWide) +
            "</div><div class=\"opening phone\">" + draw_hv(study, kPhone) + "</div></div>");
    out += report::section("table", "Speeds", "",
                           study_table(study) +
                               "<p>All digits: <a download=\"hv.csv\" "
                               "href=\"data:text/csv;charset=utf-8," +
                               sweep::encode_address(hv_csv(study)) + "\">hv.csv</a></p>\n");
    return out + "</main>\n" + report::close_page();
}

}  // namespace ice::attain
