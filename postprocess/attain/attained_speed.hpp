// SPDX-License-Identifier: GPL-3.0-or-later
/// Where thrust and resistance meet.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "postprocess/attain/read_thrusts.hpp"

namespace ice::attain {

/// Resistance at a speed, with the half width of its 95 % interval (NaN: unknown).
struct SpeedPoint {
    double speed = 0.0, resistance = 0.0, half = 0.0;  ///< [m/s], [N], [N]
};

/// Resistance as a polynomial of the speed.
struct ResistanceFit {
    Eigen::VectorXd coefficient;          ///< of 1, V, V^2 [N, N s/m, ..]; 2 or 3
    Eigen::MatrixXd covariance;           ///< of them, [2 x 2] or [3 x 3]
    double t = 0.0;                       ///< half widths per deviation [-]; NaN: unknown
    double slowest = 0.0, fastest = 0.0;  ///< speeds that it was fitted to [m/s]

    /// Resistance at a speed [m/s] >= 0: [N], beyond the fitted speeds the curve continued.
    double at(double speed) const;
    double half(double speed) const;  ///< half width of the curve's 95 % interval [N]
};

/// Weighted least squares: a line, as in Lindqvist's and Riska's formulas, or from four speeds on a
/// parabola where that misses the points by less per degree of freedom. Intervals come from the
/// points' own, widened by the root of chi^2 per degree of freedom where the points miss the curve
/// by more; without intervals from the misses, with Student's t.
/// Three points have no parabola: it would pass through them whatever they are.
/// @param points in any order, resistances of 3D runs; several at one speed may occur
/// @pre two different speeds or more; fewer end the program with an assertion
ResistanceFit fit_resistance(const std::vector<SpeedPoint>& points);

/// How an attained speed is to be taken.
enum class Reach {
    within,   ///< the speed lies within the simulated range
    outside,  ///< the curve was continued beyond that range
    stuck,    ///< the thrust is not enough at rest
    beyond    ///< the ice never holds the ship: no speed
};

struct AttainedSpeed {
    double speed = 0.0, low = 0.0, high = 0.0;  ///< [m/s]; low and high: 95 %, NaN: unknown
    Reach reach = Reach::within;
};

/// The first speed, from rest, at which the thrust no longer exceeds the resistance.
///
/// The interval is where the thrust meets the resistance's interval: low at R + half, high at
/// R - half; without an interval (fit.t NaN) both are NaN. Stuck: speed 0. Beyond: NaN. No speed
/// above 50 m/s, or above Thrust::fastest(), is tried.
AttainedSpeed attained_speed(const ResistanceFit& fit, const Thrust& thrust);

/// The attained speed [m/s] for a resistance [N] over the speed [m/s] without interval: 0 where the
/// thrust at rest is not enough, NaN where nothing holds the ship.
double attained_speed(const std::function<double(double)>& resistance, const Thrust& thrust);

}  // namespace ice::attain
