// SPDX-License-Identifier: GPL-3.0-or-later
/// Runs that differ in their seed only become one point with an interval.
#pragma once

#include <array>
#include <map>

#include "common/base/assert.hpp"
#include "postprocess/sweep/read_sweep.hpp"

namespace ice::sweep {

/// Parts of the resistance. Bow, sides, bottom and rest add up to it, so do contact (normal forces)
/// and friction, and each place's contact and friction to that place; so do breaking and submersion
/// of runs with floes held until they bend, which others do not have (NaN).
enum class Part {
    total,
    bow,
    sides,
    bottom,
    rest,
    contact,
    friction,
    bow_contact,
    sides_contact,
    bottom_contact,
    rest_contact,
    bow_friction,
    sides_friction,
    bottom_friction,
    rest_friction,
    breaking,
    submersion
};
/// Number of parts: that of the names above, by which arrays of parts are indexed.
inline constexpr std::size_t kPartCount = 17;
/// "resistance", "bow", "sides", ..., "bow_contact", ...
const char* part_name(Part part);

/// Which part a region of the hull belongs to, by its mesh group's name: bow, stem, forefoot ->
/// bow; side, shoulder -> sides; bottom, bilge, keel -> bottom; everything else -> rest.
Part part_of_region(const std::string& region);

/// Mean and half width of its 95 % interval [N; 2D: N/m]; NaN where unknown.
struct Estimate {
    double mean, half;
};

/// Mean of independent values with Student's interval:
///
///     mean +- t_{0.975, n-1} s / sqrt(n)
///
/// One value has no interval (NaN), none has no mean either.
/// Source: Student (1908), "The probable error of a mean", Biometrika 6.
Estimate estimate_mean(const std::vector<double>& values);

/// All completed runs of one combination of the axes' values.
struct Point {
    std::map<std::string, Setting> at;       ///< value of each axis
    std::array<Estimate, kPartCount> parts;  ///< by Part [N; 2D: N/m]
    double lindqvist;               ///< mean of the runs' submersion resistance [N], or NaN
    Estimate peak;                  ///< of the runs' largest resistance in a step [N; 2D: N/m]
    double largest;                 ///< the largest of them [N], or NaN
    int dimension;                  ///< 2 or 3
    std::vector<std::size_t> runs;  ///< rows of Sweep::runs
    std::string hold = {};          ///< release rules of the runs, "; " between different ones
    std::vector<FormulaValue> formulas = {};      ///< means over the runs
    bool level_ice = false;                       ///< its runs break level ice
    std::optional<CrackParticulars> cracks = {};  ///< means over the runs that have them

    const Estimate& part(Part p) const { return parts[static_cast<std::size_t>(p)]; }
    /// Value of x. @pre the sweep has an x and the point a number there
    double x(const Sweep& sweep) const {
        ICE_ASSERT(at.contains(sweep.x) && at.at(sweep.x).number.has_value());
        return at.at(sweep.x).number.value();
    }
    /// Value of a formula's part [N], or NaN.
    double formula(const std::string& name, const std::string& part) const;
};

/// Points in the order of the axes' values, the first axis slowest.
///
/// Over several seeds intervals are Student's; of one run the resistance has the run's own interval
/// from its autocorrelation, its parts have none. No completed run gives no points. Runs from
/// before summary.json split regions into contact and friction have NaN for these parts.
std::vector<Point> make_points(const Sweep& sweep);

/// Points that differ along x only, x rising: a curve. Label: values of the other axes.
struct Curve {
    std::string label;
    std::vector<Point> points;
};
std::vector<Curve> make_curves(const Sweep& sweep, const std::vector<Point>& points);

}  // namespace ice::sweep
