// SPDX-License-Identifier: GPL-3.0-or-later
/// Coefficients of the component formula from resistances that were computed or measured.
#pragma once

#include <cstddef>
#include <vector>

#include "common/formulas/coefficients_file.hpp"

namespace ice::fit {

/// A resistance and the variables of the formula.
struct FitPoint {
    SpencerScales scales;     ///< of (F3), docs/method.md
    double resistance = 0.0;  ///< [N]
    double half = 0.0;        ///< half width of its 95 % interval [N]; NaN: unknown
    bool level_ice = false;   ///< it has a breaking part; scales.strength is known
};

/// Fitted coefficients of (F3) [-] with their 95 % intervals.
struct SpencerFit {
    SpencerCoefficients coefficients;
    CoefficientIntervals intervals;
    std::size_t broken = 0, level = 0;  ///< numbers of points of either kind
    /// Points of level ice that C_BR and b are fitted to; those with less resistance than R_B + R_C
    std::size_t level_used = 0, level_below = 0;
    bool exponent_fitted = false;  ///< else Jeong's, for want of a third speed
    bool breaking_fitted = false;  ///< level ice at two strength numbers or more
    double residual = 0.0;         ///< rms of (fit - resistance) / resistance [-]
};

/// Least squares, weighted with the points' intervals where all have one.
///
/// Broken ice gives C_B, C_C and a at once: min sum w (R - C_B X - C_C Fr^-a Y)^2. That is the
/// usual way, C_B from the creeping run and a line through log(R - R_B), but for the clearing that
/// a creeping ship has as well. Two speeds give C_B and C_C with Jeong's a. Level ice then gives
/// C_BR and b by a line through log((R - R_B - R_C) / Y) over log S.
///
/// X = drho g h B T and Y = rho_i B h V^2 [N]. The exponent is found by Gauss-Newton steps from the
/// best of a scan, since the sum has more than one minimum in it; it stays at 2 or below.
/// Intervals are those of linearised least squares: from the points' own intervals, widened by the
/// root of chi^2 per degree of freedom where points miss the curve by more; without intervals from
/// the misses alone, with Student's t.
/// @param points in any order; resistances > 0
/// @throws Error (exit code 2) without points, or with fewer than two speeds of broken ice
SpencerFit fit_spencer(const std::vector<FitPoint>& points);

/// The fit's resistance at a point [N]; of level ice without a fitted breaking part the breaking
/// term has Jeong's coefficients.
double fitted_resistance(const SpencerFit& fit, const FitPoint& point);

}  // namespace ice::fit
