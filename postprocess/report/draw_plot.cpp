// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/report/draw_plot.hpp"

#include <fmt/format.h>

#include <limits>

#include "common/base/error.hpp"
#include "postprocess/report/sections.hpp"
#include "postprocess/report/write_report.hpp"
#include "postprocess/views/chart.hpp"

namespace ice::report {

namespace {

// Charts side by side [-]: with two, a picture on A4 still has readable text.
constexpr int kColumns = 2;

// paths of the tracked floes, x to the right and another axis up
std::string draw_paths(const std::vector<views::Trail>& trails, int axis) {
    views::Chart chart;
    chart.title = axis == 1 ? "Paths of tracked floes, from above" : "Paths, from starboard";
    chart.x_title = "x from the ship's origin [m]";
    chart.y_title = axis == 1 ? "y [m], to port" : "z [m]";
    for (const views::Trail& trail : trails) {
        views::Curve curve{fmt::format("{}", trail.floe), trail.color, {}, 1.6, trail.dash, 1.0};
        for (const Vec3& p : trail.offset) curve.points.emplace_back(p.x(), p[axis]);
        chart.curves.push_back(std::move(curve));
    }
    return draw_chart(chart);
}

}  // namespace

std::string draw_plot(const read::RunFolder& run) {
    const double from = run.summary ? run.summary->average_from : 0.0;
    const double mean =
        run.summary ? run.summary->resistance.mean : std::numeric_limits<double>::quiet_NaN();
    const ForceUnit unit = page_unit(run);
    const auto histories = force_histories(run.data, from, mean, unit);
    if (histories.empty())
        throw bad_input(run.path.string(), "the run has no histories to plot",
                        "it ended before its first samples were written");
    std::vector<std::string> charts;
    for (const History& h : histories) charts.push_back(draw_history(h));
    // a share over a single frame is no curve
    const auto coverage = statistics::measure_bottom_coverage(run.data, kReportFrames);
    if (coverage.share.size() > 1) charts.push_back(draw_coverage(coverage));
    const auto trails = make_trails(run.data);
    if (!trails.empty()) {
        // in a section all paths have y = 0
        if (run.data.header.dimension == 3) charts.push_back(draw_paths(trails, 1));
        charts.push_back(draw_paths(trails, 2));
    }
    for (std::size_t track = 0; track < run.data.tracks.size(); ++track)
        for (const History& h : track_histories(run.data, track, unit))
            charts.push_back(draw_history(h));
    // two columns of charts of equal size, in the order in which they were made
    const views::Chart size;  // all charts have the default size
    const auto rows = (charts.size() + kColumns - 1) / kColumns;
    const double gap = 12.0, title = 30.0;
    std::string out = views::svg_open(kColumns * (size.width + gap),
                                      title + static_cast<double>(rows) * (size.height + gap),
                                      run.data.header.title);
    out += views::text_element(8.0, 20.0, run.data.header.title, "start",
                               "font-weight=\"700\" font-size=\"16\"");
    for (std::size_t k = 0; k < charts.size(); ++k) {
        const std::size_t column = k % kColumns, row = k / kColumns;
        out += fmt::format("<g transform=\"translate({} {})\">\n{}</g>\n",
                           views::pixels(static_cast<double>(column) * (size.width + gap)),
                           views::pixels(title + static_cast<double>(row) * (size.height + gap)),
                           charts[k]);
    }
    return out + "</svg>\n";
}

}  // namespace ice::report
