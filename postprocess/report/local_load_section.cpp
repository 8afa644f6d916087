// SPDX-License-Identifier: GPL-3.0-or-later
// Peaks per region and loads on the hull's panels, as solver/record measured them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "postprocess/report/page.hpp"
#include "postprocess/report/sections.hpp"
#include "postprocess/report/tables.hpp"
#include "postprocess/statistics/panel_map.hpp"
#include "postprocess/views/chart.hpp"
#include "postprocess/views/load_view.hpp"
#include "postprocess/views/svg.hpp"

namespace ice::report {

using views::readable;

namespace {

// Rows of the panels' table [-]: the hardest ones. summary.json and run.h5 have more. More make the
// page longer.
constexpr std::size_t kMostRows = 10;
constexpr const char* kCurveColours[] = {views::kBlue,   views::kOrange, views::kGreen,
                                         views::kPurple, views::kBlack,  "#e69f00",
                                         "#56b4e9"};

using Regions = std::vector<std::pair<std::string, RegionStatistics>>;

// Regions with a force, in the hull's order: that of the charts of forces on regions.
Regions pressed_regions(const RunData& run, const Summary& s) {
    Regions out;
    if (run.header.shapes.empty()) return out;
    for (const std::string& name : run.header.shapes[0].mesh.region_names) {
        const auto found = s.regions.find(name);
        // summaries of older programs have regions without peaks
        if (found == s.regions.end() || !found->second.force_peaks) continue;
        if (found->second.force_peaks->max > 0.0) out.emplace_back(name, found->second);
    }
    return out;
}

// units of the section, one per quantity
struct Units {
    ForceUnit force, line;
    PressureUnit pressure;
    int pressure_decimals = 0;
    std::string line_load(double value) const { return line.text(value); }
    std::string of_pressure(double value) const {
        return fmt::format("{:.{}f}", value / pressure.pascals, pressure_decimals);
    }
};

// Decimals that show three digits of the largest number of a quantity.
int three_digits(double largest) {
    if (!(largest > 0.0)) return 0;
    return std::clamp(2 - static_cast<int>(std::floor(std::log10(largest))), 0, 4);
}

Units units_of(const RunData& run, const ForceUnit& force) {
    // one unit and one number of digits for all tables of the section, by the largest values
    double line = 0.0, pressure = 0.0;
    for (const PanelLoad& p : run.panels.panels) {
        line = std::max(line, p.max / p.length);
        pressure = std::max(pressure, p.max / p.area);
    }
    // in 2D forces are line loads themselves
    Units out{force, run.header.dimension == 2 ? force : choose_unit(line, 2),
              choose_pressure_unit(pressure)};
    if (run.header.dimension == 3) out.line.decimals = three_digits(line / out.line.newtons);
    out.pressure_decimals = three_digits(pressure / out.pressure.pascals);
    return out;
}

std::string peak_table(const Regions& regions, const Summary& s, const Units& units,
                       double lengths) {
    // Peaks are counted over the averaged time, so both rates are independent of the run's length.
    // rates per hour of averaged time, and per ship length of way where that is known
    const double hours = (s.simulated_s - s.average_from) / 3600.0;
    double most = 0.0;
    for (const auto& [name, region] : regions)
        most = std::max(most, static_cast<double>(region.force_peaks->count));
    const auto per = [most](double count, double whole) {  // one number of digits for all regions
        return std::isfinite(whole) && whole > 0.0
                   ? fmt::format("{:.{}f}", count / whole, three_digits(most / whole))
                   : std::string("n/a");
    };
    std::vector<std::vector<std::string>> rows;
    for (const auto& [name, region] : regions) {
        const PeakStatistics& peaks = *region.force_peaks;
        const auto count = static_cast<double>(peaks.count);
        rows.push_back(
            {name, std::to_string(peaks.count), per(count, hours), per(count, lengths),
             units.force.text(peaks.mean), units.force.text(peaks.p99), units.force.text(peaks.max),
             region.line_load_peaks ? units.line_load(region.line_load_peaks->p99) : "",
             region.line_load_peaks ? units.line_load(region.line_load_peaks->max) : ""});
    }
    const std::string force = " [" + units.force.name + "]", line = " [" + units.line.name + "]";
    return table({"Region", "Peaks", "per hour", "per ship length", "Mean" + force, "99 %" + force,
                  "Largest" + force, "Line load, 99 %" + line, "Line load, largest" + line},
                 rows);
}

std::string panel_table(const Summary& s, const Units& units, int dimension) {
    std::vector<std::vector<std::string>> rows;
    for (const auto& [region, p] : s.panels.hardest) {
        if (rows.size() == kMostRows) break;
        // the list is in order of the largest line load already
        const std::string at =
            dimension == 2
                ? fmt::format("{:.2f}, {:.2f}", p.center.x(), p.center.z())
                : fmt::format("{:.2f}, {:.2f}, {:.2f}", p.center.x(), p.center.y(), p.center.z());
        rows.push_back({region, at, fmt::format("{:.3f}", p.area),
                        units.line_load(p.mean / p.length), units.line_load(p.p99 / p.length),
                        units.line_load(p.max / p.length), units.of_pressure(p.mean / p.area),
                        units.of_pressure(p.p99 / p.area), units.of_pressure(p.max / p.area)});
    }
    const std::string line = "Line load [" + units.line.name + "], ";
    const std::string pressure = "Pressure [" + units.pressure.name + "], ";
    return table({"Panel in region", dimension == 2 ? "at x, z [m]" : "at x, y, z [m]",
                  dimension == 2 ? "Area [m²/m]" : "Area [m²]", line + "mean", "99 %", "largest",
                  pressure + "mean", "99 %", "largest"},
                 rows);
}

// levels against how often they are exceeded
std::string draw_exceedance(const std::string& title, const std::string& y_title,
                            const Regions& regions, double newtons,
                            std::optional<PeakStatistics> RegionStatistics::*peaks) {
    views::Chart chart;
    chart.title = title;
    chart.x_title = "peaks per hour as large or larger";
    chart.y_title = y_title;
    // rare peaks are the ones that a designer needs: decades give them as much room as frequent
    // ones
    chart.x_logarithmic = true;
    for (const auto& [name, region] : regions) {
        if (!(region.*peaks)) continue;
        const std::size_t colour = chart.curves.size() % std::size(kCurveColours);
        views::Curve curve{name, kCurveColours[colour], {}, 1.8, "", 1.0};
        for (const Exceedance& e : (region.*peaks)->exceeded)
            curve.points.emplace_back(e.per_hour, e.level / newtons);
        chart.curves.push_back(std::move(curve));
    }
    return draw_chart(chart);
}

std::string exceedance_table(const Regions& regions, const Units& units) {
    std::vector<std::vector<std::string>> rows;
    for (const auto& [name, region] : regions)
        for (const Exceedance& e : region.force_peaks->exceeded)
            rows.push_back({name, units.force.text(e.level), readable(e.per_hour)});
    return "<details><summary>Exceedance in numbers</summary>\n" +
           table(
               {"Region", "Force [" + units.force.name + "]", "Peaks per hour as large or larger"},
               rows) +
           "</details>\n";
}

std::string draw_panels(const RunData& run, const RunFigures& figures) {
    const statistics::LoadMap map = statistics::make_panel_map(run, figures.load.mesh);
    const double end = statistics::scale_end(map);
    if (!(end > 0.0) || run.frames.empty()) return "";
    return "<h3>Largest pressure on each panel</h3>\n" +
           draw_hull_loads(run, map, end, "largest pressure");
}

}  // namespace

std::string local_load_section(const read::RunFolder& run, const RunFigures& figures,
                               double lengths) {
    if (!run.summary) return "";
    const Summary& s = *run.summary;
    const Regions regions = pressed_regions(run.data, s);
    if (regions.empty()) return "";
    const int dimension = run.data.header.dimension;
    const Units units = units_of(run.data, figures.unit);
    const PanelSummary& panels = s.panels;
    // From coarse to fine: rates and sizes by region, how often a level is exceeded, then single
    // panels.
    std::string body = peak_table(regions, s, units, lengths);
    body += report::figures(
        {draw_exceedance("Peaks of the force on a region", "force [" + units.force.name + "]",
                         regions, units.force.newtons, &RegionStatistics::force_peaks),
         draw_exceedance("Peaks of the line load on its hardest panel",
                         "line load [" + units.line.name + "]", regions, units.line.newtons,
                         &RegionStatistics::line_load_peaks)});
    body += exceedance_table(regions, units);
    if (!panels.hardest.empty()) {
        body += fmt::format("<h3>The {} hardest of {} loaded panels</h3>\n",
                            std::min(kMostRows, panels.hardest.size()), panels.touched);
        body += panel_table(s, units, dimension) + draw_panels(run.data, figures);
    }
    return section(
        "local", "Peaks, line loads and pressures",
        fmt::format(
            "Sums of normal forces (port and starboard do not cancel), as means over windows of {} "
            "s: in a single step a force is an impulse divided by the time step and has no limit. "
            "A "
            "peak is the largest window between two up-crossings of the mean. Panels are {}: the "
            "thickness of the ice, but at least two spacings of the hull's spheres. A line load is "
            "force {}, pressure force over the panel's area. Design loads of class rules (IACS UR "
            "I2) are not computed.",
            readable(panels.window),
            dimension == 2 ? fmt::format("pieces of the section of {:.3g} m", panels.size)
                           : fmt::format("patches of {0:.3g} m x {0:.3g} m", panels.size),
            dimension == 2 ? "per metre of breadth"
                           : "over the panel's length along the waterline"),
        body);
}

}  // namespace ice::report
