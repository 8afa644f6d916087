// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/report/viewer_charts.hpp"

#include <algorithm>
#include <cmath>

#include "postprocess/views/chart.hpp"

namespace ice::report {

using nlohmann::json;

namespace {

json pack_curve(const std::string& chart, const History::Curve& curve, Pack& pack) {
    // 16 bits for each curve by its own largest value: a step of 1/32000 of it is far below a
    // pixel, and the page has a quarter of the bytes of doubles.
    double most = 0.0;
    for (const double v : curve.values)
        if (std::isfinite(v)) most = std::max(most, std::abs(v));
    const Quantiser unit{most > 0.0 ? most / 32000.0 : 1.0, 0.0};
    std::vector<std::int16_t> codes;
    for (const double v : curve.values) codes.push_back(unit.code(v));
    const std::string name = chart + " " + curve.name;
    const std::size_t length = codes.size();
    // averages are smooth and are stored as differences; differences of samples are as large as
    // samples
    pack.add_series(name, std::move(codes), length, curve.average ? 1 : 0);
    return {{"label", curve.name},
            {"array", name},
            {"color", curve.color},
            {"width", curve.average ? 2 : 1},
            // Samples are pale, because their average is drawn over them.
            {"alpha", curve.average ? 1.0 : 0.35},
            {"scale", unit.step}};
}

json pack_history(const History& h, double average_from, Pack& pack) {
    json series = json::array();
    for (const History::Curve& curve : h.curves) series.push_back(pack_curve(h.id, curve, pack));
    // The viewer draws the same chart as the page's SVG: unit, range and shading come from one
    // place.
    json chart = {{"id", h.id},
                  {"title", h.title},
                  {"unit", h.y_title},
                  {"time", "history_time"},
                  {"range", {h.low, h.high}},
                  {"averaged", {{"from", average_from}, {"to", h.time.back()}}},
                  {"series", series}};
    if (h.mean) chart["mean"] = *h.mean;
    return chart;
}

json pack_coverage(const statistics::BottomCoverage& coverage, Pack& pack) {
    std::vector<float> time(coverage.time.begin(), coverage.time.end()), share;
    for (const double s : coverage.share) share.push_back(static_cast<float>(100.0 * s));
    // its own times: coverage has one value per frame, histories one per output row
    pack.add("coverage_time", time);
    pack.add("coverage", share);
    const json curve = {{"label", "covered"},
                        {"array", "coverage"},
                        {"color", views::kBlue},
                        {"width", 2},
                        {"scale", 1.0}};
    return {{"id", "coverage"},
            {"title", "Bottom covered by ice"},
            {"unit", "share [%]"},
            {"time", "coverage_time"},
            {"series", json::array({curve})}};
}

}  // namespace

json pack_charts(const std::vector<History>& histories, const statistics::BottomCoverage& coverage,
                 double average_from, Pack& pack) {
    json charts = json::array();
    std::vector<float> time;
    // All histories have the same rows and share one array of times.
    if (!histories.empty()) time.assign(histories[0].time.begin(), histories[0].time.end());
    pack.add("history_time", time);
    for (const History& h : histories) charts.push_back(pack_history(h, average_from, pack));
    if (coverage.share.size() > 1) charts.push_back(pack_coverage(coverage, pack));
    return charts;
}

}  // namespace ice::report
