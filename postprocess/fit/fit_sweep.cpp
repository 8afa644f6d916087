// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/fit/fit_sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <set>

#include "common/formulas/formula_band.hpp"
#include "postprocess/report/tables.hpp"
#include "postprocess/sweep/affected_runs.hpp"

namespace ice::fit {

namespace {

bool begins_with_any(const std::string& key, std::initializer_list<const char*> beginnings) {
    return std::any_of(beginnings.begin(), beginnings.end(),
                       [&](const char* beginning) { return key.starts_with(beginning); });
}

// Settings that the formula has inputs for, or that say which part of it a run has.
bool is_formula_axis(const std::string& key) {
    static const std::vector<std::string> kKnown{
        sweep::kSpeedKey,     "field.ice.thickness",       "level_ice.thickness",
        "ice.density",        "environment.water_density", "bending.flexural_strength",
        "field.specification"};
    return std::find(kKnown.begin(), kKnown.end(), key) != kKnown.end() || key.ends_with(".hold");
}

// Settings of the ice alone: runs in broken and in level ice differ in them because their ice does.
bool is_kind_of_ice(const sweep::Sweep& sweep, const std::string& key) {
    if (!begins_with_any(key, {"floes.", "field.", "level_ice.", "bending."})) return false;
    std::set<std::string> broken, level;
    for (const sweep::SweepRun& run : sweep.runs)
        if (run.summary) (is_level_ice(run.summary->ice) ? level : broken).insert(run.text(key));
    return broken.size() < 2 && level.size() < 2;
}

std::string with_half(double value, double half) {
    return std::isfinite(half) ? fmt::format("{:.4g} +- {:.2g}", value, half)
                               : fmt::format("{:.4g}, no interval", value);
}

}  // namespace

std::vector<FitPoint> fit_points(const sweep::Sweep& sweep, const std::vector<sweep::Point>& points,
                                 double flexural_strength) {
    std::vector<FitPoint> out;
    for (const sweep::Point& point : points) {
        const Summary& s = *sweep.runs[point.runs.front()].summary;
        // The formula contains the breadth, which a section does not have, and its breaking part is
        // fitted through logarithms of forces, which must be positive.
        if (point.dimension != 3 || !(point.part(sweep::Part::total).mean > 0.0)) continue;
        // (F3) has no angles of the bow: they are set to 0.
        const HullDimensions hull{s.ship.length, s.ship.breadth, s.ship.draught, 0.0, 0.0};
        // The option comes before the case: runs of broken ice have no strength of their own.
        const double strength =
            std::isfinite(flexural_strength) ? flexural_strength : s.ice.flexural_strength;
        FitPoint p;
        p.scales = spencer_scales(
            hull, {s.ice.thickness, 0.0, s.ice.density, s.ice.water_density, s.ice.gravity,
                   std::abs(s.ship.speed_mean), point.level_ice ? strength : kUnknown});
        p.resistance = point.part(sweep::Part::total).mean;
        p.half = point.part(sweep::Part::total).half;
        p.level_ice = point.level_ice;
        if (std::isfinite(p.scales.weight) && std::isfinite(p.scales.froude)) out.push_back(p);
    }
    return out;
}

namespace {

struct Fitted {
    std::string name;
    double value, half;
    bool is_factor;  // of a force, which is not negative; exponents may be
};

std::vector<Fitted> list_fitted(const SpencerFit& fit) {
    const SpencerCoefficients& c = fit.coefficients;
    const CoefficientIntervals& i = fit.intervals;
    std::vector<Fitted> out{{"C_B", c.buoyancy, i.buoyancy, true},
                            {"C_C", c.clearing, i.clearing, true}};
    if (fit.exponent_fitted) out.push_back({"a", c.clearing_exponent, i.clearing_exponent, false});
    if (fit.breaking_fitted) {
        out.push_back({"C_BR", c.breaking, i.breaking, true});
        out.push_back({"b", c.breaking_exponent, i.breaking_exponent, false});
    }
    return out;
}

void warn_of_coefficients(const SpencerFit& fit, std::vector<std::string>& out) {
    for (const Fitted& c : list_fitted(fit)) {
        if (c.is_factor && c.value < 0.0)
            out.push_back(
                fmt::format("{} = {} is negative, which no force of the ice is: --coefficients "
                            "refuses the file; add runs, and longer ones",
                            c.name, with_half(c.value, c.half)));
        else if (c.half >= std::abs(c.value))
            out.push_back(
                fmt::format("{} = {} is not determined by these runs: its 95 % interval contains "
                            "0; add runs, and longer ones",
                            c.name, with_half(c.value, c.half)));
    }
}

// A curve through all points has no misses, whatever the points are.
void warn_of_few_points(const SpencerFit& fit, std::vector<std::string>& out) {
    const auto add = [&](const char* kind, std::size_t points, std::size_t unknowns) {
        if (points <= unknowns)
            out.push_back(fmt::format(
                "{} points of {} ice for {} coefficients: the curve passes through them whatever "
                "they are, and no miss shows how good it is; add runs at other speeds",
                points, kind, unknowns));
    };
    add("broken", fit.broken, fit.exponent_fitted ? 3 : 2);
    if (fit.breaking_fitted) add("level", fit.level_used, 2);
}

}  // namespace

std::vector<std::string> fit_warnings(const sweep::Sweep& sweep, const SpencerFit& fit) {
    std::vector<std::string> out;
    // The fit would take the effect of another axis for one of speed or thickness.
    for (const std::string& axis : sweep.axes)
        if (!is_formula_axis(axis) && !is_kind_of_ice(sweep, axis))
            out.push_back(
                fmt::format("{} varies between the runs, which the formula leaves out: "
                            "fit a sweep over speed and thickness alone",
                            axis));
    if (!fit.exponent_fitted)
        out.push_back(fmt::format("two speeds give no exponent: it stays at {}; add a third speed",
                                  fit.coefficients.clearing_exponent));
    if (fit.level > 0 && !fit.breaking_fitted)
        out.push_back(
            "level ice at one strength number gives no breaking part: add another speed or "
            "thickness, or say --flexural-strength");
    if (fit.level_below > 0)
        out.push_back(fmt::format(
            "{} of {} points of level ice have less resistance than the fit to broken ice alone: "
            "they are left out of C_BR and b",
            fit.level_below, fit.level));
    warn_of_few_points(fit, out);
    warn_of_coefficients(fit, out);
    if (const std::string affected = sweep::affected_line(sweep); !affected.empty())
        out.push_back(affected + ": the coefficients are fitted to these means");
    return out;
}

std::string fit_text(const SpencerFit& fit, const std::vector<FitPoint>& points) {
    const SpencerCoefficients& c = fit.coefficients;
    const CoefficientIntervals& i = fit.intervals;
    std::string out =
        fmt::format("{} points of broken ice, {} of level ice\n", fit.broken, fit.level);
    out += fmt::format("  C_B    {}\n  C_C    {}\n", with_half(c.buoyancy, i.buoyancy),
                       with_half(c.clearing, i.clearing));
    if (fit.exponent_fitted)
        out += fmt::format("  a      {}\n", with_half(c.clearing_exponent, i.clearing_exponent));
    if (fit.breaking_fitted)
        out += fmt::format("  C_BR   {}\n  b      {}\n", with_half(c.breaking, i.breaking),
                           with_half(c.breaking_exponent, i.breaking_exponent));
    out += fmt::format("  misses {:.1f} % (rms)\n", 100.0 * fit.residual);
    // One unit for the whole table, by its largest force.
    double largest = 0.0;
    for (const FitPoint& p : points) largest = std::max(largest, p.resistance);
    const report::ForceUnit unit = report::choose_unit(largest, 3);
    out += fmt::format("{:>10} {:>12} {:>12}  ice\n", "Froude h", "runs [" + unit.name + "]",
                       "fit [" + unit.name + "]");
    for (const FitPoint& p : points)
        out +=
            fmt::format("{:>10.3f} {:>12} {:>12}  {}\n", p.scales.froude, unit.text(p.resistance),
                        unit.text(fitted_resistance(fit, p)), p.level_ice ? "level" : "broken");
    return out;
}

}  // namespace ice::fit
