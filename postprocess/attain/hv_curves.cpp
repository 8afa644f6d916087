// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/attain/hv_curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "common/base/error.hpp"
#include "postprocess/sweep/key_names.hpp"

namespace ice::attain {

namespace {

using sweep::Part;
using sweep::Point;
using sweep::Sweep;

// A free ship slower than this is held by the ice [m/s]: 60 m in ten minutes. With a larger bound a
// ship that creeps through would count as stuck.
constexpr double kStuckSpeed = 0.1;
constexpr const char* kFreedom = "ship.free";  // separates free ships from others
// Steps of a formula's curve over the thicknesses: it is smooth, and 24 steps show no corners. Each
// costs a search for a root.
constexpr int kFormulaSteps = 24;

// Thickness in steps of 0.1 mm: measured thicknesses of one specification differ by less.
long rounded(double thickness) { return std::lround(1e4 * thickness); }

struct Row {
    const Point* point;
    const Summary* summary;  // of the first run
    double thickness;
};

struct FreeSpeed {
    double mean, half;
};

// None where the ship kept a given speed.
std::optional<FreeSpeed> free_speed(const Sweep& sweep, const Row& row) {
    std::vector<double> speeds;
    double half = std::nan("");
    for (const std::size_t run : row.point->runs) {
        const auto numbers = read_json_numbers(sweep.runs[run].folder / "summary.json");
        // Only a ship that is free in surge has an interval of its speed.
        const auto own = numbers.find("ship.speed_ci95");
        if (own == numbers.end()) return std::nullopt;
        speeds.push_back(sweep.runs[run].summary->ship.speed_mean);
        half = own->second;
    }
    const sweep::Estimate mean = sweep::estimate_mean(speeds);
    return FreeSpeed{mean.mean, speeds.size() == 1 ? half : mean.half};
}

class Maker {
public:
    Maker(const Sweep& sweep, const std::vector<Thrust>& thrusts, const FormulaOptions& formulas)
        : sweep_(sweep), thrusts_(thrusts), formulas_(formulas), points_(make_points(sweep)) {}

    HvStudy make() {
        take_rows();
        for (const auto& [label, rows] : groups_) add_group(label, rows);
        if (study_.curves.empty())
            throw bad_input(sweep_.folder.string(),
                            thrusts_.empty() ? "has no ship that is free in surge, so a thrust is "
                                               "needed"
                                             : "has no thickness with runs at two speeds",
                            thrusts_.empty() ? "give --thrust FILE" : "add runs at other speeds");
        return study_;
    }

private:
    // points by the values of axes other than speed and thickness
    void take_rows() {
        for (const Point& point : points_) {
            const Summary& s = *sweep_.runs[point.runs.front()].summary;
            if (point.dimension == 3 && std::isfinite(s.ice.thickness))
                rows_.push_back({&point, &s, s.ice.thickness});
        }
        if (rows_.empty())
            throw bad_input(sweep_.folder.string(),
                            "has no run in 3D that states its ice thickness",
                            "run its cases again");
        study_.level_ice = rows_.front().point->level_ice;
        std::vector<std::string> other;
        for (const std::string& axis : sweep_.axes)
            // A key that changes with the thickness alone, such as the ice's file, or that only
            // free ships have, such as their power, names the same axis again.
            if (axis != sweep::kSpeedKey && axis != kFreedom && !follows_thickness(axis) &&
                !follows_freedom(axis))
                other.push_back(axis);
        for (const Row& row : rows_) {
            std::string label;
            for (const std::string& axis : other)
                label += (label.empty() ? "" : ", ") +
                         sweep::name_value(axis, row.point->at.at(axis), false);
            groups_[label].push_back(row);
        }
    }

    // each of the axis' values has one thickness, and each thickness one value
    bool follows_thickness(const std::string& axis) const {
        std::map<std::string, long> of_value;
        std::map<long, std::string> of_thickness;
        for (const Row& row : rows_) {
            const std::string value = row.point->at.at(axis).text;
            const long h = rounded(row.thickness);
            if (of_value.emplace(value, h).first->second != h ||
                of_thickness.emplace(h, value).first->second != value)
                return false;
        }
        return true;
    }

    // one value in all runs of free ships and one in all those on a prescribed course
    bool follows_freedom(const std::string& axis) const {
        if (std::ranges::find(sweep_.axes, kFreedom) == sweep_.axes.end()) return false;
        std::map<std::string, std::string> of_freedom;
        return std::all_of(rows_.begin(), rows_.end(), [&](const Row& row) {
            const std::string value = row.point->at.at(axis).text;
            return of_freedom.emplace(row.point->at.at(kFreedom).text, value).first->second ==
                   value;
        });
    }

    void add_group(const std::string& label, const std::vector<Row>& rows) {
        HvCurve free{
            Source::free_ship, label.empty() ? "free ship" : "free ship, " + label, "", {}};
        std::map<long, std::vector<Row>> by_thickness;
        for (const Row& row : rows) {
            const auto speed = free_speed(sweep_, row);
            if (!speed) {
                by_thickness[rounded(row.thickness)].push_back(row);
                continue;
            }
            // a run of a free ship attains its speed, runs on a prescribed course give a resistance
            // to be fitted
            const bool stuck = speed->mean < kStuckSpeed;
            free.points.push_back(
                {row.thickness,
                 {speed->mean, std::max(0.0, speed->mean - speed->half), speed->mean + speed->half,
                  stuck ? Reach::stuck : Reach::within}});
        }
        const auto thinner = [](const HvPoint& a, const HvPoint& b) {
            return a.thickness < b.thickness;
        };
        std::sort(free.points.begin(), free.points.end(), thinner);
        if (!free.points.empty()) study_.curves.push_back(free);
        const auto fits = fit_all(by_thickness);
        for (const Thrust& thrust : thrusts_) {
            add_course(label, thrust, fits);
            if (!fits.empty() || !free.points.empty()) add_formulas(label, thrust, rows);
        }
    }

    std::map<double, ResistanceFit> fit_all(const std::map<long, std::vector<Row>>& by_thickness) {
        std::map<double, ResistanceFit> out;
        for (const auto& [h, rows] : by_thickness) {
            std::vector<SpeedPoint> speeds;
            for (const Row& row : rows) {
                // the whole resistance; ships that go astern have negative speeds
                const sweep::Estimate r = row.point->part(Part::total);
                speeds.push_back({std::abs(row.summary->ship.speed_mean), r.mean, r.half});
            }
            // a fit through one speed has no slope, and its root would be the extrapolation of a
            // guess
            const bool one = std::all_of(speeds.begin(), speeds.end(), [&](const SpeedPoint& p) {
                return std::abs(p.speed - speeds.front().speed) < 1e-6;
            });
            if (one)
                study_.warnings.push_back(
                    fmt::format("{:g} m of ice was run at one speed only: no curve through it",
                                rows.front().thickness));
            else
                out.emplace(rows.front().thickness, fit_resistance(speeds));
        }
        return out;
    }

    void add_course(const std::string& label, const Thrust& thrust,
                    const std::map<double, ResistanceFit>& fits) {
        HvCurve curve{
            Source::prescribed_course, label.empty() ? "computed" : label, thrust.name, {}};
        // One point for each thickness: the map has them in rising order.
        for (const auto& [thickness, fit] : fits)
            curve.points.push_back({thickness, attained_speed(fit, thrust)});
        const auto outside =
            std::count_if(curve.points.begin(), curve.points.end(),
                          [](const HvPoint& p) { return p.attained.reach == Reach::outside; });
        if (outside > 0)
            study_.warnings.push_back(fmt::format(
                "{}: {} of {} speeds lie outside the speeds of the runs, on the extrapolated curve",
                thrust.name, outside, curve.points.size()));
        if (!curve.points.empty()) study_.curves.push_back(curve);
    }

    // at thicknesses between the least and the largest, ship and ice else as in the first run
    void add_formulas(const std::string& label, const Thrust& thrust,
                      const std::vector<Row>& rows) {
        const auto [low, high] = std::minmax_element(
            rows.begin(), rows.end(),
            [](const Row& a, const Row& b) { return a.thickness < b.thickness; });
        const Summary& s = *rows.front().summary;
        IceParticulars ice = s.ice;
        // speed and thickness vary, all else of ship and ice stays
        const auto at = [&](double thickness, double speed) {
            ice.thickness = thickness;
            return comparable_formulas(evaluate_formulas(s.ship, ice, speed, formulas_),
                                       study_.level_ice);
        };
        for (const FormulaValue& formula : at(low->thickness, 1.0)) {
            // by name: a formula that is no number at some speed is missing there
            const auto value = [&](double thickness, double speed) {
                for (const FormulaValue& f : at(thickness, speed))
                    if (f.name == formula.name && f.part == formula.part) return f.value;
                return std::nan("");
            };
            // a formula without a number at rest does not show whether a ship is stuck
            if (std::isnan(value(low->thickness, 0.0))) continue;
            HvCurve curve{
                Source::formula,
                formula.name + ", " + formula.part + (label.empty() ? "" : " (" + label + ")"),
                thrust.name,
                {}};
            const int steps = high->thickness > low->thickness ? kFormulaSteps : 0;
            for (int i = 0; i <= steps; ++i) {
                const double h =
                    low->thickness + (high->thickness - low->thickness) * i / kFormulaSteps;
                AttainedSpeed reached;
                reached.speed = attained_speed([&](double u) { return value(h, u); }, thrust);
                reached.low = reached.high = std::nan("");
                if (std::isnan(reached.speed)) reached.reach = Reach::beyond;
                if (reached.speed == 0.0) reached.reach = Reach::stuck;
                curve.points.push_back({h, reached});
            }
            study_.curves.push_back(curve);
        }
    }

    const Sweep& sweep_;
    const std::vector<Thrust>& thrusts_;
    const FormulaOptions& formulas_;
    std::vector<Point> points_;
    std::vector<Row> rows_;
    std::map<std::string, std::vector<Row>> groups_;
    HvStudy study_;
};

}  // namespace

HvStudy make_hv(const Sweep& sweep, const std::vector<Thrust>& thrusts,
                const FormulaOptions& formulas) {
    return Maker(sweep, thrusts, formulas).make();
}

}  // namespace ice::attain
