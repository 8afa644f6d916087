// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/report/histories.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "postprocess/statistics/thin_series.hpp"
#include "postprocess/views/chart.hpp"

namespace ice::report {

namespace {

constexpr std::size_t kBins = 1000;      // of a curve: about two per pixel
constexpr std::size_t kTrackBins = 120;  // of each floe's curves, which are many
constexpr double kShown = 0.96;          // of the averages lie inside the axis
constexpr std::size_t kFew = 20;         // averages: then all are shown

// Forces over one time, before they are thinned [N].
struct Series {
    std::vector<std::string> names;
    std::vector<const char*> colors;
    std::vector<std::vector<double>> force;
};

struct Style {
    double window;      // of the averages [s]
    std::size_t bins;   // of a curve
    bool samples;       // drawn beside the averages
    double shown_from;  // averages from here on set the axis [s]
    double shown;       // share of them that the axis shows
    double mean;        // [N], NaN: none
};

// Range that the middle `share` of some values lies in, with zero.
std::pair<double, double> middle_range(std::vector<double> values, double share) {
    if (values.empty()) return {0.0, 0.0};
    std::sort(values.begin(), values.end());
    const double last = static_cast<double>(values.size() - 1);
    const double tail = values.size() < kFew ? 0.0 : 0.5 * (1.0 - share);
    const auto at = [&](double part) { return values[static_cast<std::size_t>(part * last)]; };
    return {std::min(0.0, at(tail)), std::max(0.0, at(1.0 - tail))};
}

double largest_of(const std::vector<std::vector<double>>& lists) {
    double most = 0.0;
    for (const auto& list : lists)
        for (const double v : list)
            if (std::isfinite(v)) most = std::max(most, std::abs(v));
    return most;
}

History make_history(const std::string& id, const std::string& title, const std::string& axis,
                     const std::vector<double>& time, const Series& series, const Style& style,
                     int dimension) {
    const auto thin = statistics::thin_series(time, series.force, style.bins);
    std::vector<std::vector<double>> average;
    std::vector<double> shown;
    for (const auto& force : series.force) {
        average.push_back(statistics::moving_average(time, force, style.window, thin.time));
        for (std::size_t k = 0; k < thin.time.size(); ++k)
            if (thin.time[k] >= style.shown_from) shown.push_back(average.back()[k]);
    }
    if (std::isfinite(style.mean)) shown.push_back(style.mean);
    const auto [low, high] = middle_range(std::move(shown), style.shown);

    History h;
    h.id = id;
    h.title = title;
    h.unit = choose_unit(std::max(-low, high), dimension);
    h.y_title = fmt::format("{} [{}]", axis, h.unit.name);
    h.low = low / h.unit.newtons;
    h.high = high / h.unit.newtons;
    h.peak = largest_of(series.force) / h.unit.newtons;
    if (std::isfinite(style.mean)) h.mean = style.mean / h.unit.newtons;
    h.time = thin.time;
    const auto add = [&](const std::vector<std::vector<double>>& lists, bool is_average) {
        for (std::size_t k = 0; k < lists.size(); ++k) {
            std::vector<double> values = lists[k];
            for (double& v : values) v /= h.unit.newtons;
            const bool named = is_average && style.samples;
            h.curves.push_back({named ? series.names[k] + ", mean" : series.names[k],
                                series.colors[k], std::move(values), is_average});
        }
    };
    if (style.samples) add(thin.values, false);
    add(average, true);
    return h;
}

// a thirtieth of the run, cut to one digit
double long_window(const std::vector<double>& time) {
    const double raw = std::max((time.back() - time.front()) / 30.0, 1e-9);
    const double digit = std::pow(10.0, std::floor(std::log10(raw)));
    return std::floor(raw / digit) * digit;
}

}  // namespace

double average_window(const std::vector<HistoryRow>& history) {
    if (history.size() < 2) return 0.5;
    const double step =
        (history.back().time - history.front().time) / static_cast<double>(history.size() - 1);
    return std::max(0.5, 5.0 * step);
}

std::vector<History> force_histories(const RunData& run, double average_from, double mean) {
    std::vector<History> out;
    if (run.history.size() < 2) return out;
    std::vector<double> time;
    std::vector<std::vector<double>> contact(3), friction(3), resistance(2);
    for (const HistoryRow& row : run.history) {
        time.push_back(row.time);
        for (int axis = 0; axis < 3; ++axis) {
            contact[static_cast<std::size_t>(axis)].push_back(row.contact_force[axis]);
            friction[static_cast<std::size_t>(axis)].push_back(row.friction_force[axis]);
        }
        resistance[0].push_back(-(row.contact_force.x() + row.friction_force.x()));
        resistance[1].push_back(-row.friction_force.x());
    }
    Style style{long_window(time), kBins, false, average_from, kShown, mean};
    out.push_back(make_history(
        "resistance", fmt::format("Resistance, moving average over {:g} s", style.window),
        "resistance", time,
        {{"contact + friction", "friction"}, {views::kBlue, views::kOrange}, resistance}, style,
        run.header.dimension));
    style = {average_window(run.history), kBins, true, average_from, kShown, std::nan("")};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (run.header.dimension == 2 && axis == 1) continue;
        const char name = "xyz"[axis];
        out.push_back(make_history(fmt::format("force-{}", name),
                                   fmt::format("Force of the ice on the ship, {}", name),
                                   fmt::format("f{}", name), time,
                                   {{"contact", "friction"},
                                    {views::kBlue, views::kOrange},
                                    {contact[axis], friction[axis]}},
                                   style, run.header.dimension));
    }
    return out;
}

std::vector<History> track_histories(const RunData& run, std::size_t track) {
    std::vector<History> out;
    const auto& rows = run.tracks[track];
    const bool touched = std::any_of(rows.begin(), rows.end(), [](const TrackRow& r) {
        return r.contact_force.squaredNorm() > 0.0;
    });
    if (rows.size() < 2 || !touched) return out;
    std::vector<double> time;
    for (const TrackRow& row : rows) time.push_back(row.time);
    const Style style{average_window(run.history), kTrackBins, true, 0.0, 1.0, std::nan("")};
    const std::string floe = std::to_string(run.header.tracked[track]);
    for (const auto& [name, force] : {std::pair("contact", &TrackRow::contact_force),
                                      std::pair("friction", &TrackRow::friction_force)}) {
        Series series;
        const char* colors[] = {views::kBlue, views::kGreen, views::kOrange};
        for (int axis = 0; axis < 3; ++axis) {
            if (run.header.dimension == 2 && axis == 1) continue;
            series.names.emplace_back(1, "xyz"[axis]);
            series.colors.push_back(colors[axis]);
            series.force.emplace_back();
            for (const TrackRow& row : rows) series.force.back().push_back((row.*force)[axis]);
        }
        out.push_back(make_history("floe-" + floe + "-" + name,
                                   "Floe " + floe + " on the ship, " + name, "force", time, series,
                                   style, run.header.dimension));
    }
    return out;
}

}  // namespace ice::report
