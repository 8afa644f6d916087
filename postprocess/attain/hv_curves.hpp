// SPDX-License-Identifier: GPL-3.0-or-later
/// Attainable speed against ice thickness, from a sweep.
#pragma once

#include <string>
#include <vector>

#include "common/formulas/formula_band.hpp"
#include "postprocess/attain/attained_speed.hpp"
#include "postprocess/sweep/sweep_points.hpp"

namespace ice::attain {

/// Basis of a curve of attained speeds.
enum class Source {
    prescribed_course,  ///< resistance at given speeds, met by a thrust
    free_ship,          ///< ships that were free in surge
    formula             ///< an empirical formula, met by a thrust
};

/// One attained speed.
struct HvPoint {
    double thickness = 0.0;  ///< [m]
    AttainedSpeed attained;
};

/// Attained speeds over the thickness from one source.
struct HvCurve {
    Source source = Source::prescribed_course;
    std::string name;             ///< thrust, formula, values of other axes
    std::string thrust;           ///< its name; "" for free ships, whose cases have it
    std::vector<HvPoint> points;  ///< by thickness, rising; never empty
};

/// All curves of a sweep.
struct HvStudy {
    std::vector<HvCurve> curves;
    bool level_ice = false;             ///< else ice that is broken from the start
    std::vector<std::string> warnings;  ///< thicknesses at one speed, speeds outside
};

/// Curves of a sweep in 3D over speed and thickness, one for each thrust and each combination of
/// other axes; of free ships their mean speeds with their own intervals; and of each formula that
/// can be compared with the resistance.
///
/// A thickness with fewer than two speeds has no point and a warning. Runs in 2D and runs without a
/// thickness do not count. Runs are free ships where summary.json has
/// `ship.speed_ci95`.
/// @throws Error (exit code 2) where nothing can be drawn: no thrust and no free ship, no
///         thickness with two speeds
/// @param thrusts net thrusts, met by the resistances; empty: free ships alone
HvStudy make_hv(const sweep::Sweep& sweep, const std::vector<Thrust>& thrusts,
                const FormulaOptions& formulas);

/// CSV (RFC 4180): source, curve, thrust, thickness_m, speed, speed_low, speed_high, speed_kn,
/// reach. Thickness [m], speeds [m/s] but speed_kn [kn]; unknown numbers are empty.
std::string hv_csv(const HvStudy& study);

/// Chart: speed [m/s] against thickness [m] with intervals; formulas dashed.
/// @param width of the picture [px]; it is 420 px high
std::string draw_hv(const HvStudy& study, double width);

/// The page: chart, table, basis of the curves.
std::string make_hv_page(const sweep::Sweep& sweep, const HvStudy& study);

}  // namespace ice::attain
