// SPDX-License-Identifier: GPL-3.0-or-later
/// Which input changes the resistance most, and whether the difference exceeds the seeds' scatter.
#pragma once

#include "common/base/uncertainty.hpp"
#include "postprocess/sensitivity/read_study.hpp"
#include "postprocess/sweep/sweep_points.hpp"

namespace ice::sensitivity {

using sweep::Estimate;

/// Mean of an ensemble [N; 2D: N/m]: Student's interval over its seeds; of a single run the run's
/// own. NaN without a run.
Estimate estimate_ensemble(const Seeds& ensemble);

/// Mean of b less mean of a with Welch's 95 % interval:
///
///     half = t_{0.975, v} sqrt(q_a + q_b),   q = s^2 / n,
///     v = (q_a + q_b)^2 / (q_a^2 / (n_a - 1) + q_b^2 / (n_b - 1))
///
/// with s the standard deviation over the n seeds [N; 2D: N/m] and v the degrees of freedom [-].
/// Where an ensemble has one run only, its interval is the run's own and the two half widths add as
/// squares. NaN where one of them has no value, or no interval.
/// Source: Welch (1947), "The generalization of 'Student's' problem", Biometrika 34.
Estimate estimate_difference(const Seeds& a, const Seeds& b);

/// One value of an input against the case.
struct Change {
    std::string label;                ///< the input's value, as text
    Estimate resistance, difference;  ///< [N; 2D: N/m]
    /// Whether the interval of the difference leaves out zero.
    bool significant() const;
};

/// An input with its changes, ready for tables and chart.
struct RankedInput {
    std::string name, base, source;  ///< its value in the case; source of its range
    std::vector<Change> changes;     ///< in the plan's order
    double largest() const;          ///< largest |difference| [N; 2D: N/m]; 0 without one
};

/// Inputs with the largest difference first; equal ones, and those without a result, in the plan's
/// order.
std::vector<RankedInput> rank_inputs(const Study& study);

}  // namespace ice::sensitivity
