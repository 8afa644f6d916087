// SPDX-License-Identifier: GPL-3.0-or-later
// Sections of the report with curves over time: forces, regions of the hull, tracked floes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "postprocess/report/page.hpp"
#include "postprocess/report/sections.hpp"
#include "postprocess/views/chart.hpp"
#include "postprocess/views/decimate.hpp"

namespace ice::report {

using views::Chart;
using views::Curve;

namespace {

// Bins of a drawn curve [-]: one in two pixels of a chart of 480 px. The viewer has kBins of
// histories.cpp; with as many here the charts would take the room of the drawings.
constexpr std::size_t kDrawnBins = 250;

}  // namespace

std::string draw_coverage(const statistics::BottomCoverage& coverage) {
    Chart chart;
    chart.title = "Bottom covered by ice";
    chart.y_title = "share [%]";
    Curve curve{"", views::kBlue, {}, 1.8, "", 1.0};
    for (std::size_t k = 0; k < coverage.share.size(); ++k)
        // Coverage has a value for each frame only: few enough to draw all.
        curve.points.emplace_back(coverage.time[k], 100.0 * coverage.share[k]);
    chart.curves = {curve};
    return draw_chart(chart);
}

std::string draw_history(const History& h) {
    Chart chart;
    chart.title = h.title;
    chart.y_title = h.y_title;
    for (const History::Curve& curve : h.curves) {
        // samples have the colour of their averages and are not named again
        const bool is_samples = !curve.average;
        Curve line{is_samples ? "" : curve.name, curve.color, {}, 0.8, "", 0.35};
        if (curve.average) {
            line.width = 1.8;
            line.opacity = 1.0;
        }
        line.points = views::decimate(h.time, curve.values, kDrawnBins);
        chart.curves.push_back(std::move(line));
    }
    // room for the samples around their averages; single peaks go beyond
    const double room = 0.2 * (h.high - h.low);
    if (room > 0.0)
        chart.y_range = {h.low < 0.0 ? h.low - room : 0.0, h.high > 0.0 ? h.high + room : 0.0};
    chart.level = h.mean;
    chart.level_name = "mean";
    return draw_chart(chart);
}

namespace {

// The largest contact force along each axis, without friction: the charts' axes leave it out.
std::string hits_text(const RunData& run, const RunFigures& figures) {
    std::string out;
    for (const History& h : figures.histories) {
        if (!h.id.starts_with("force-")) continue;
        const int axis = h.id.back() - 'x';
        double largest = 0.0;
        for (const HistoryRow& row : run.history)
            largest = std::max(largest, std::abs(row.contact_force[axis]));
        out += fmt::format("{}{} {}", out.empty() ? "" : ", ", h.id.back(),
                           figures.unit.text(largest));
    }
    return out;
}

std::string axes_note(const RunData& run, const RunFigures& figures) {
    return fmt::format(
        "Thick: moving averages, weighted with a bell (Hann's window) that is {} s wide at half "
        "its height, here and in all charts of this page. Thin: samples. The shaded time is the "
        "averaged one. A force is the sum of the impulses of a step divided by the time step, so "
        "the height of a single hit depends on the step: the axes span the middle 96 % of the "
        "averages after {} s. Single hits of the contact force, without friction, reach {} {}. The "
        "bottom's coverage is the share of the wetted hull, seen from below, that ice hides.",
        views::readable(average_window(run.history)), views::readable(figures.average_from),
        hits_text(run, figures), figures.unit.name);
}

std::string chart_section(const std::string& id, const std::string& heading,
                          const std::string& intro, const std::vector<History>& histories,
                          const std::string& before) {
    std::vector<std::string> charts;
    for (const History& h : histories) charts.push_back(chart_holder(h.id, draw_history(h)));
    return section(id, heading, intro, before + report::figures(charts));
}

}  // namespace

std::string history_section(const RunData& run, const RunFigures& figures) {
    if (figures.histories.empty())
        return section("histories", "Forces against time", "",
                       "<p>The run recorded no history.</p>\n");
    std::vector<std::string> charts;
    for (const History& h : figures.histories)
        charts.push_back(chart_holder(h.id, draw_history(h)));
    if (figures.coverage.share.size() > 1)
        charts.push_back(chart_holder("coverage", draw_coverage(figures.coverage)));
    // hidden until the page's script shows it: without script there is no chart that it could
    // change
    const std::string toggle =
        "<p class=\"peaks\"><label hidden=\"hidden\"><input type=\"checkbox\" name=\"peaks\" /> "
        "show single peaks to their full height</label></p>\n";
    return section("histories", "Forces against time", axes_note(run, figures),
                   toggle + report::figures(charts));
}

std::string region_section(const RunFigures& figures, const std::string& table) {
    if (table.empty() && figures.regions.empty()) return "";
    return chart_section(
        "regions", "Regions of the hull",
        "Means of the same time as above. A hit is counted when a floe begins to touch the region; "
        "an impulse is that of one floe in one step. Charts: moving averages of contact and "
        "friction together.",
        figures.regions, table);
}

std::string track_section(const RunData& run, const ForceUnit& unit) {
    std::string body, untouched;
    for (std::size_t k = 0; k < run.tracks.size(); ++k) {
        const std::string id = std::to_string(run.header.tracked[k]);
        const auto histories = track_histories(run, k, unit);
        if (histories.empty()) {
            // A floe that the ship never touched would have a chart of zeros: its number is enough.
            untouched += (untouched.empty() ? "" : ", ") + id;
            continue;
        }
        std::vector<std::string> charts;
        for (const History& h : histories) charts.push_back(draw_history(h));
        body += "<h3>Floe " + id + "</h3>\n" + figures(charts);
    }
    if (!untouched.empty()) body += "<p>Never touched by the ship: floe " + untouched + ".</p>\n";
    if (body.empty()) return "";
    return section(
        "tracked", "Tracked floes",
        "Force of each floe on the ship, world axes; samples are cut where they are far higher "
        "than "
        "the moving averages.",
        fmt::format("<details><summary>Forces of {} floes</summary>\n", run.tracks.size()) + body +
            "</details>\n");
}

}  // namespace ice::report
