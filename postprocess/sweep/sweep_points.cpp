// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/sweep/sweep_points.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include "common/base/uncertainty.hpp"
#include "common/formulas/formula_band.hpp"
#include "postprocess/report/tables.hpp"
#include "postprocess/sweep/key_names.hpp"

namespace ice::sweep {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

using Share = std::array<double, 3> RegionStatistics::*;

// The place on the hull where a part acts and its share of the force there; Part::total is
// everywhere.
struct PartRow {
    const char* name;
    Part place;
    Share share;
};

constexpr Share kAll = &RegionStatistics::mean, kContact = &RegionStatistics::contact_mean,
                kFriction = &RegionStatistics::friction_mean;

// in the order of Part
constexpr PartRow kPartRows[kPartCount]{{"resistance", Part::total, kAll},
                                        {"bow", Part::bow, kAll},
                                        {"sides", Part::sides, kAll},
                                        {"bottom", Part::bottom, kAll},
                                        {"rest", Part::rest, kAll},
                                        {"contact", Part::total, kContact},
                                        {"friction", Part::total, kFriction},
                                        {"bow_contact", Part::bow, kContact},
                                        {"sides_contact", Part::sides, kContact},
                                        {"bottom_contact", Part::bottom, kContact},
                                        {"rest_contact", Part::rest, kContact},
                                        {"bow_friction", Part::bow, kFriction},
                                        {"sides_friction", Part::sides, kFriction},
                                        {"bottom_friction", Part::bottom, kFriction},
                                        {"rest_friction", Part::rest, kFriction},
                                        {"breaking", Part::total, kAll},
                                        {"submersion", Part::total, kAll}};

const PartRow& row_of(Part part) { return kPartRows[static_cast<std::size_t>(part)]; }

double part_value(const Summary& s, Part part) {
    // parts of the whole ship are in the summary itself; places on the hull are sums over regions
    if (part == Part::total) return s.resistance.mean;
    if (part == Part::contact) return s.resistance.contact_mean;
    if (part == Part::friction) return s.resistance.friction_mean;
    if (part == Part::breaking) return s.resistance.breaking_mean.value_or(kNaN);
    if (part == Part::submersion) return s.resistance.submersion_mean.value_or(kNaN);
    const auto [name, place, share] = row_of(part);
    double sum = 0.0;
    for (const auto& [region, force] : s.regions)
        if (part_of_region(region) == place) sum -= (force.*share)[0];  // resistance is -f_x
    return sum + 0.0;                                                   // no -0
}

std::vector<FormulaValue> mean_formulas(const Sweep& sweep, const std::vector<std::size_t>& rows) {
    std::vector<FormulaValue> out;
    std::vector<std::vector<double>> values;
    for (const std::size_t row : rows)
        for (const FormulaValue& f : report::formulas_of(*sweep.runs[row].summary)) {
            // Runs of a point have the same formulas, but a formula without a value in one run is
            // missing there: the mean is over the runs that have it.
            const auto found = std::find_if(out.begin(), out.end(), [&](const FormulaValue& known) {
                return known.name == f.name && known.part == f.part;
            });
            const auto k = static_cast<std::size_t>(found - out.begin());
            if (k == out.size()) {
                out.push_back(f);
                values.emplace_back();
            }
            values[k].push_back(f.value);
        }
    for (std::size_t k = 0; k < out.size(); ++k) out[k].value = estimate_mean(values[k]).mean;
    return out;
}

Point make_point(const Sweep& sweep, const std::map<std::string, Setting>& at,
                 const std::vector<std::size_t>& rows) {
    Point point{at, {}, kNaN, {kNaN, kNaN}, kNaN, 3, rows};
    const Summary& first = *sweep.runs[rows.front()].summary;
    point.dimension = first.dimension;
    for (std::size_t k = 0; k < kPartCount; ++k) {
        std::vector<double> values;
        for (const std::size_t row : rows)
            values.push_back(part_value(*sweep.runs[row].summary, static_cast<Part>(k)));
        point.parts[k] = estimate_mean(values);
    }
    // one run has the interval of its own series; several have that between them
    if (rows.size() == 1) point.parts[0].half = first.resistance.ci95;
    std::vector<double> lindqvist;
    for (const std::size_t row : rows)
        if (const auto& value = sweep.runs[row].summary->lindqvist_submersion)
            lindqvist.push_back(*value);
    std::vector<double> peaks;
    for (const std::size_t row : rows) peaks.push_back(sweep.runs[row].summary->resistance.max);
    point.peak = estimate_mean(peaks);
    // of runs that broke off no largest force is known
    if (std::isfinite(point.peak.mean))
        point.largest = *std::max_element(peaks.begin(), peaks.end());
    point.lindqvist = estimate_mean(lindqvist).mean;
    point.formulas = mean_formulas(sweep, rows);
    point.level_ice = is_level_ice(first.ice);
    std::vector<CrackParticulars> cracks;
    for (const std::size_t row : rows)
        if (const auto& known = sweep.runs[row].summary->cracks) cracks.push_back(*known);
    point.cracks = mean_cracks(cracks);
    return point;
}

// Setting has no ==, which would have to compare "0.50" with 0.5: neither before the other is equal
struct Before {
    const std::vector<std::string>& axes;
    bool operator()(const std::map<std::string, Setting>& a,
                    const std::map<std::string, Setting>& b) const {
        for (const std::string& axis : axes) {
            if (a.at(axis) < b.at(axis)) return true;
            if (b.at(axis) < a.at(axis)) return false;
        }
        return false;
    }
};

bool contains_any(const std::string& text, std::initializer_list<const char*> words) {
    return std::any_of(words.begin(), words.end(),
                       [&](const char* word) { return text.find(word) != std::string::npos; });
}

}  // namespace

double Point::formula(const std::string& name, const std::string& part) const {
    for (const FormulaValue& f : formulas)
        if (f.name == name && f.part == part) return f.value;
    return kNaN;
}

const char* part_name(Part part) { return row_of(part).name; }

Part part_of_region(const std::string& region) {
    // by parts of the region's name, as shipbuilders use them
    std::string name = region;
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (contains_any(name, {"bow", "stem", "forefoot"})) return Part::bow;
    if (contains_any(name, {"side", "shoulder"})) return Part::sides;
    if (contains_any(name, {"bottom", "bilge", "keel"})) return Part::bottom;
    return Part::rest;
}

Estimate estimate_mean(const std::vector<double>& values) {
    const auto n = static_cast<double>(values.size());
    if (values.empty()) return {kNaN, kNaN};
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
    // One run has no scatter between fields; its own interval is added by the caller.
    if (values.size() == 1 || !std::isfinite(mean)) return {mean, kNaN};
    // Student's interval: t_{n-1} s / sqrt(n), s^2 = sum (x - mean)^2 / (n - 1).
    double square = 0.0;
    for (const double value : values) square += (value - mean) * (value - mean);
    return {mean, student_quantile(n - 1.0, 0.05) * std::sqrt(square / (n - 1.0) / n)};
}

namespace {

std::string release_rules(const Sweep& sweep, const std::vector<std::size_t>& rows) {
    std::set<std::string> rules;
    for (const std::size_t row : rows) rules.insert(release_rule(sweep.runs[row].summary->ice));
    return fmt::format("{}", fmt::join(rules, "; "));
}

}  // namespace

std::vector<Point> make_points(const Sweep& sweep) {
    // Runs with equal settings, seeds aside, are one point.
    std::map<std::map<std::string, Setting>, std::vector<std::size_t>, Before> groups(
        Before{sweep.axes});
    for (std::size_t row = 0; row < sweep.runs.size(); ++row) {
        const SweepRun& run = sweep.runs[row];
        if (!run.summary) continue;
        std::map<std::string, Setting> at;
        for (const std::string& axis : sweep.axes) {
            const auto found = run.settings.find(axis);
            at[axis] = found == run.settings.end() ? Setting{} : found->second;
        }
        groups[at].push_back(row);
    }
    std::vector<Point> points;
    for (const auto& [at, rows] : groups) {
        points.push_back(make_point(sweep, at, rows));
        points.back().hold = release_rules(sweep, rows);
    }
    return points;
}

std::vector<Curve> make_curves(const Sweep& sweep, const std::vector<Point>& points) {
    const auto label_of = [&](const Point& point, bool whole) {
        std::string label;
        for (const std::string& axis : sweep.axes) {
            if (axis == sweep.x) continue;
            label += (label.empty() ? "" : ", ") + name_value(axis, point.at.at(axis), whole);
        }
        return label;
    };
    // full labels distinguish curves, short ones are shown where they suffice
    std::map<std::string, std::size_t> row_of, count_of;
    std::vector<Curve> curves;
    for (const Point& point : points) {
        const auto& x = point.at.at(sweep.x).number;
        if (!x || !std::isfinite(*x)) continue;  // a pressure of inf has no place on an axis
        const auto [entry, added] = row_of.emplace(label_of(point, true), curves.size());
        if (added) curves.push_back({label_of(point, false), {}});
        if (added) ++count_of[curves.back().label];
        curves[entry->second].points.push_back(point);
    }
    for (Curve& curve : curves) {
        // files of one name in several folders need their folders
        if (count_of[curve.label] > 1) curve.label = label_of(curve.points.front(), true);
        std::stable_sort(curve.points.begin(), curve.points.end(),
                         [&](const Point& a, const Point& b) { return a.x(sweep) < b.x(sweep); });
    }
    return curves;
}

}  // namespace ice::sweep
