// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "postprocess/report/page.hpp"
#include "postprocess/report/pictures.hpp"
#include "postprocess/report/tables.hpp"
#include "postprocess/views/chart.hpp"
#include "postprocess/views/decimate.hpp"

namespace ice::report {

using views::Chart;
using views::Curve;

namespace {

constexpr std::size_t kBins = 1000;      // of a curve: about two per pixel
constexpr std::size_t kTrackBins = 500;  // of each floe's curves, which are many
constexpr const char* kAxis = "xyz";

double largest_of(const std::vector<double>& values) {
    double most = 0.0;
    for (const double v : values)
        if (std::isfinite(v)) most = std::max(most, std::abs(v));
    return most;
}

// A column of forces, thinned and in the unit.
Curve make_curve(const std::string& name, const char* color, const std::vector<double>& time,
                 const std::vector<double>& force, const ForceUnit& unit, std::size_t bins) {
    Curve curve{name, color, views::decimate(time, force, bins), 1.0, ""};
    for (auto& p : curve.points) p.y() /= unit.newtons;
    return curve;
}

template <class Row, class Value>
std::vector<double> column(const std::vector<Row>& rows, const Value& value) {
    std::vector<double> out;
    out.reserve(rows.size());
    for (const Row& row : rows) out.push_back(value(row));
    return out;
}

// Moving averages show the load behind the hits.
std::string average_chart(const RunData& run, const std::vector<double>& time, double average_from,
                          double mean) {
    const auto total = column(run.history, [](const HistoryRow& r) {
        return -(r.contact_force.x() + r.friction_force.x());
    });
    const auto friction =
        column(run.history, [](const HistoryRow& r) { return -r.friction_force.x(); });
    // a thirtieth of the run, cut to one digit
    const double raw = std::max((time.back() - time.front()) / 30.0, 1e-9);
    const double digit = std::pow(10.0, std::floor(std::log10(raw)));
    const double window = std::floor(raw / digit) * digit;
    Chart chart;
    chart.title = fmt::format("Resistance, moving average over {} s", views::readable(window));
    Curve all{"contact + friction", views::kBlue,
              views::moving_average(time, total, 0.5 * window, 400), 1.8, ""};
    Curve part{"friction", views::kOrange, views::moving_average(time, friction, 0.5 * window, 400),
               1.8, "7 2"};
    double most = 0.0;
    for (const auto& p : all.points) most = std::max(most, std::abs(p.y()));
    const ForceUnit unit = choose_unit(most, run.header.dimension);
    for (Curve* curve : {&all, &part})
        for (auto& p : curve->points) p.y() /= unit.newtons;
    chart.y_title = "resistance [" + unit.name + "]";
    chart.curves = {all, part};
    if (std::isfinite(mean)) {
        chart.level = mean / unit.newtons;
        chart.level_name = "mean";
        chart.averaged = {average_from, time.back()};
    }
    return draw_chart(chart);
}

}  // namespace

std::string history_section(const RunData& run, double average_from, double mean) {
    if (run.history.size() < 2)
        return section("histories", "Force histories", "", "<p>The run recorded no history.</p>\n");
    const auto time = column(run.history, [](const HistoryRow& r) { return r.time; });
    std::vector<std::string> charts{average_chart(run, time, average_from, mean)};
    for (int axis = 0; axis < 3; ++axis) {
        if (run.header.dimension == 2 && axis == 1) continue;
        const auto contact =
            column(run.history, [&](const HistoryRow& r) { return r.contact_force[axis]; });
        const auto friction =
            column(run.history, [&](const HistoryRow& r) { return r.friction_force[axis]; });
        const ForceUnit unit =
            choose_unit(std::max(largest_of(contact), largest_of(friction)), run.header.dimension);
        Chart chart;
        chart.title = fmt::format("Force of the ice on the ship, {}", kAxis[axis]);
        chart.y_title = fmt::format("f{} [{}]", kAxis[axis], unit.name);
        chart.curves = {make_curve("contact", views::kBlue, time, contact, unit, kBins),
                        make_curve("friction", views::kOrange, time, friction, unit, kBins)};
        if (std::isfinite(mean)) chart.averaged = {average_from, time.back()};
        charts.push_back(draw_chart(chart));
    }
    return section(
        "histories", "Force histories",
        "A force is the sum of the impulses of a step divided by the time step, so the height "
        "of a single hit depends on the step. Curves are thinned; every peak is kept. Shaded: "
        "the time over which means are taken.",
        figures(charts));
}

std::string track_section(const RunData& run) {
    std::string body;
    for (std::size_t k = 0; k < run.tracks.size(); ++k) {
        const auto& rows = run.tracks[k];
        if (rows.size() < 2) continue;
        const auto time = column(rows, [](const TrackRow& r) { return r.time; });
        const auto chart_of = [&](const std::string& title,
                                  const std::function<Vec3(const TrackRow&)>& force) {
            Chart chart;
            chart.title = title;
            std::vector<std::vector<double>> parts;
            double most = 0.0;
            for (int axis = 0; axis < 3; ++axis) {
                parts.push_back(column(rows, [&](const TrackRow& r) { return force(r)[axis]; }));
                most = std::max(most, largest_of(parts.back()));
            }
            const ForceUnit unit = choose_unit(most, run.header.dimension);
            chart.y_title = "force [" + unit.name + "]";
            const char* colors[] = {views::kBlue, views::kGreen, views::kOrange};
            for (int axis = 0; axis < 3; ++axis) {
                if (run.header.dimension == 2 && axis == 1) continue;
                chart.curves.push_back(make_curve(std::string(1, kAxis[axis]), colors[axis], time,
                                                  parts[static_cast<std::size_t>(axis)], unit,
                                                  kTrackBins));
            }
            return draw_chart(chart);
        };
        const std::string id = std::to_string(run.header.tracked[k]);
        body += "<h3>Floe " + id + "</h3>\n" +
                figures({chart_of("Floe " + id + " on the ship, contact",
                                  [](const TrackRow& r) { return r.contact_force; }),
                         chart_of("Floe " + id + " on the ship, friction",
                                  [](const TrackRow& r) { return r.friction_force; })});
    }
    if (body.empty()) return "";
    return section("tracked", "Tracked floes", "Force of each floe on the ship, world axes.", body);
}

}  // namespace ice::report
