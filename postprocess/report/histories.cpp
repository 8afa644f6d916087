// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/report/histories.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "postprocess/statistics/thin_series.hpp"
#include "postprocess/views/chart.hpp"

namespace ice::report {

namespace {

// Bins of a curve [-], each with its lowest and highest sample: about two per pixel of a wide
// chart. The page's size grows in proportion.
constexpr std::size_t kBins = 1000;
// Bins of each tracked floe's curves [-], which are many and small.
constexpr std::size_t kTrackBins = 120;
// Share of the averages that lie inside the axis [-]: the start and single jams may leave it. With
// 1 one jam flattens the rest of the curve.
constexpr double kShown = 0.96;
// Fewer averages than this are all shown: 4 % of them would be less than one.
constexpr std::size_t kFew = 20;
// Regions in one chart: as many as there are colours that can be told apart.
constexpr std::size_t kMostRegions = 7;
constexpr const char* kColours[kMostRegions] = {views::kBlue,   views::kOrange, views::kGreen,
                                                views::kPurple, views::kBlack,  "#e69f00",
                                                "#56b4e9"};
constexpr const char* kTrackColours[] = {views::kBlue, views::kGreen, views::kOrange};

// Forces over one time, before they are thinned [N].
struct Series {
    std::vector<std::string> names;
    std::vector<const char*> colors;
    std::vector<std::vector<double>> force;
};

struct Style {
    double window;  // of the averages [s]
    ForceUnit unit;
    double shown_from = 0.0;  // averages from here on set the axis [s]
    std::size_t bins = kBins;
    bool samples = false;   // drawn beside the averages
    double shown = kShown;  // share of the averages that the axis shows
    double mean = std::numeric_limits<double>::quiet_NaN();  // [N], NaN: none
};

// Range that the middle `share` of some values lies in, with zero.
std::pair<double, double> middle_range(std::vector<double> values, double share) {
    if (values.empty()) return {0.0, 0.0};
    std::sort(values.begin(), values.end());
    const double last = static_cast<double>(values.size() - 1);
    // of few values all are shown: a share of them would be one or two
    const double tail = values.size() < kFew ? 0.0 : 0.5 * (1.0 - share);
    const auto at = [&](double part) { return values[static_cast<std::size_t>(part * last)]; };
    return {std::min(0.0, at(tail)), std::max(0.0, at(1.0 - tail))};
}

History make_history(const std::string& id, const std::string& title, const std::string& axis,
                     const std::vector<double>& time, const Series& series, const Style& style) {
    // Averages are taken of all samples, before thinning, at the thinned times.
    const auto thin = statistics::thin_series(time, series.force, style.bins);
    std::vector<std::vector<double>> average;
    std::vector<double> shown;
    for (const auto& force : series.force) {
        average.push_back(statistics::moving_average(time, force, style.window, thin.time));
        for (std::size_t k = 0; k < thin.time.size(); ++k)
            if (thin.time[k] >= style.shown_from) shown.push_back(average.back()[k]);
    }
    // The axis always includes the mean that the page states.
    if (std::isfinite(style.mean)) shown.push_back(style.mean);
    const auto [low, high] = middle_range(std::move(shown), style.shown);

    History h;
    h.id = id;
    h.title = title;
    h.unit = style.unit;
    h.y_title = fmt::format("{} [{}]", axis, h.unit.name);
    h.low = low / h.unit.newtons;
    h.high = high / h.unit.newtons;
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

std::vector<double> times_of(const RunData& run) {
    std::vector<double> time;
    for (const HistoryRow& row : run.history) time.push_back(row.time);
    return time;
}

// 2D lives in the x-z plane
std::vector<std::size_t> axes_of(const RunData& run) {
    return run.header.dimension == 2 ? std::vector<std::size_t>{0, 2}
                                     : std::vector<std::size_t>{0, 1, 2};
}

// rows of the regions with the largest mean forces, in the hull's order
std::vector<std::size_t> choose_regions(const RunData& run) {
    std::vector<std::pair<double, std::size_t>> by_size;
    for (std::size_t r = 0; r < run.regions.size(); ++r) {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (const Eigen::Vector3f& f : run.regions[r].contact)
            // rows without forces on regions are not numbers
            if (f.allFinite()) sum += f.cast<double>();
        if (sum.squaredNorm() > 0.0) by_size.emplace_back(-sum.norm(), r);
    }
    std::sort(by_size.begin(), by_size.end());
    if (by_size.size() > kMostRegions) by_size.resize(kMostRegions);
    std::vector<std::size_t> rows;
    for (const auto& [size, row] : by_size) rows.push_back(row);
    std::sort(rows.begin(), rows.end());
    return rows;
}

}  // namespace

double average_window(const std::vector<HistoryRow>& history) {
    if (history.size() < 2) return 1.0;
    const double span = history.back().time - history.front().time;
    // a thirtieth of the run, but five rows at least
    const double raw =
        std::max({span / 30.0, 5.0 * span / static_cast<double>(history.size() - 1), 1e-9});
    const double digit = std::pow(10.0, std::floor(std::log10(raw)));
    // one digit: a window that a reader can name
    return std::floor(raw / digit * (1.0 + 1e-9)) * digit;
}

std::vector<History> force_histories(const RunData& run, double average_from, double mean,
                                     const ForceUnit& unit) {
    std::vector<History> out;
    if (run.history.size() < 2) return out;
    const std::vector<double> time = times_of(run);
    std::vector<std::vector<double>> contact(3), friction(3), resistance(2);
    for (const HistoryRow& row : run.history) {
        for (int axis = 0; axis < 3; ++axis) {
            contact[static_cast<std::size_t>(axis)].push_back(row.contact_force[axis]);
            friction[static_cast<std::size_t>(axis)].push_back(row.friction_force[axis]);
        }
        // resistance is positive against the way: -f_x
        resistance[0].push_back(-(row.contact_force.x() + row.friction_force.x()));
        resistance[1].push_back(-row.friction_force.x());
    }
    Style style{average_window(run.history), unit, average_from};
    style.mean = mean;
    out.push_back(make_history(
        "resistance", fmt::format("Resistance, moving average over {:g} s", style.window),
        "resistance", time,
        {{"contact + friction", "friction"}, {views::kBlue, views::kOrange}, resistance}, style));
    // components have no mean line: the page states that of the resistance alone
    style.mean = std::nan("");
    style.samples = true;
    for (const std::size_t axis : axes_of(run)) {
        const char name = "xyz"[axis];
        out.push_back(make_history(fmt::format("force-{}", name),
                                   fmt::format("Force of the ice on the ship, {}", name),
                                   fmt::format("f{}", name), time,
                                   {{"contact", "friction"},
                                    {views::kBlue, views::kOrange},
                                    {contact[axis], friction[axis]}},
                                   style));
    }
    return out;
}

std::vector<History> region_histories(const RunData& run, double average_from,
                                      const ForceUnit& unit) {
    std::vector<History> out;
    const auto rows = choose_regions(run);
    if (run.history.size() < 2 || rows.empty()) return out;
    const std::vector<double> time = times_of(run);
    const Style style{average_window(run.history), unit, average_from};
    static constexpr const char* kTitles[] = {"Resistance by region", "Lateral force by region",
                                              "Vertical force by region"};
    static constexpr const char* kAxes[] = {"resistance", "fy, to port", "fz, up"};
    for (const std::size_t axis : axes_of(run)) {
        Series series;
        for (const std::size_t r : rows) {
            const RegionHistory& region = run.regions[r];
            series.names.push_back(region.name);
            series.colors.push_back(kColours[series.colors.size()]);
            series.force.emplace_back();
            const auto d = static_cast<Eigen::Index>(axis);
            for (std::size_t k = 0; k < time.size(); ++k) {
                // the share of the resistance is -f_x, as of the ship's
                const double f = double{region.contact[k][d]} + double{region.friction[k][d]};
                series.force.back().push_back(axis == 0 ? -f : f);
            }
        }
        out.push_back(make_history(fmt::format("region-{}", "xyz"[axis]), kTitles[axis],
                                   kAxes[axis], time, series, style));
    }
    return out;
}

std::vector<History> moment_histories(const RunData& run, double average_from,
                                      const ForceUnit& unit) {
    std::vector<History> out;
    if (run.history.size() < 2) return out;
    Series series;
    static constexpr const char* kNames[] = {"heel, to starboard", "trim, bow down",
                                             "yaw, to port"};
    static constexpr const char* kMomentColours[] = {views::kGreen, views::kBlue, views::kOrange};
    for (int axis = 0; axis < 3; ++axis) {
        // in a plane only the moment about y exists
        if (run.header.dimension == 2 && axis != 1) continue;
        series.names.emplace_back(kNames[axis]);
        series.colors.push_back(kMomentColours[axis]);
        series.force.emplace_back();
        for (const HistoryRow& row : run.history) series.force.back().push_back(row.moment[axis]);
    }
    const Style style{average_window(run.history), moment_unit(unit), average_from};
    out.push_back(make_history("moments", "Moments of the ice on the ship", "moment", times_of(run),
                               series, style));
    return out;
}

std::vector<History> motion_histories(const RunData& run, double average_from,
                                      const ForceUnit& unit) {
    std::vector<History> out;
    if (!run.header.ship_is_free || run.history.size() < 2) return out;
    const std::vector<double> time = times_of(run);
    // one degree [rad]: the file has radians, charts have degrees
    const double degree = std::acos(-1.0) / 180.0;
    const auto add = [&](const char* id, const char* title, const ForceUnit& in, Series series) {
        Style style{average_window(run.history), in, average_from};
        style.samples = true;
        // a motion that stays constant is left out
        const bool changes = std::any_of(
            series.force.begin(), series.force.end(), [](const std::vector<double>& values) {
                return std::any_of(values.begin(), values.end(),
                                   [&](double v) { return v != values.front(); });
            });
        if (changes) out.push_back(make_history(id, title, title, time, series, style));
    };
    const auto series_of = [&](const auto& value) {
        std::vector<double> values;
        for (const HistoryRow& row : run.history) values.push_back(value(row));
        return values;
    };
    add("ship-speed", "speed of the ship", {"m/s", 1.0, 3},
        {{"along x"}, {views::kBlue}, {series_of([](const HistoryRow& r) {
             return r.ship_velocity.x();
         })}});
    add("ship-drive", "thrust, force of tow and mooring", unit,
        {{"thrust", "lines"},
         {views::kBlue, views::kOrange},
         {series_of([](const HistoryRow& r) { return r.thrust; }),
          series_of([](const HistoryRow& r) { return r.tow_force.x(); })}});
    const double height = run.history.front().ship_position.z();
    add("ship-height", "height above that of the start", {"m", 1.0, 3},
        {{"mesh origin"}, {views::kBlue}, {series_of([&](const HistoryRow& r) {
             return r.ship_position.z() - height;
         })}});
    Series angles;
    static constexpr const char* kNames[] = {"roll, to starboard", "pitch, bow down",
                                             "yaw, to port"};
    static constexpr const char* kAngleColours[] = {views::kGreen, views::kBlue, views::kOrange};
    for (int axis = 0; axis < 3; ++axis) {
        angles.names.emplace_back(kNames[axis]);
        angles.colors.push_back(kAngleColours[axis]);
        angles.force.push_back(series_of([&](const HistoryRow& r) { return r.ship_angles[axis]; }));
    }
    add("ship-angles", "angles of the ship", {"degrees", degree, 3}, std::move(angles));
    return out;
}

std::vector<History> track_histories(const RunData& run, std::size_t track, const ForceUnit& unit) {
    std::vector<History> out;
    const auto& rows = run.tracks[track];
    // a floe that the ship never touched has no curve but zero
    const bool touched = std::any_of(rows.begin(), rows.end(), [](const TrackRow& r) {
        return r.contact_force.squaredNorm() > 0.0;
    });
    if (rows.size() < 2 || !touched) return out;
    std::vector<double> time;
    for (const TrackRow& row : rows) time.push_back(row.time);
    Style style{average_window(run.history), unit};
    style.bins = kTrackBins;
    style.samples = true;
    style.shown = 1.0;
    const std::string floe = std::to_string(run.header.tracked[track]);
    for (const auto& [name, force] : {std::pair("contact", &TrackRow::contact_force),
                                      std::pair("friction", &TrackRow::friction_force)}) {
        Series series;
        for (const std::size_t axis : axes_of(run)) {
            series.names.emplace_back(1, "xyz"[axis]);
            series.colors.push_back(kTrackColours[axis]);
            series.force.emplace_back();
            for (const TrackRow& row : rows)
                series.force.back().push_back((row.*force)[static_cast<Eigen::Index>(axis)]);
        }
        out.push_back(make_history("floe-" + floe + "-" + name,
                                   "Floe " + floe + " on the ship, " + name, "force", time, series,
                                   style));
    }
    return out;
}

}  // namespace ice::report
