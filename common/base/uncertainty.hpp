// SPDX-License-Identifier: GPL-3.0-or-later
/// How well a mean is known: one model uncertainty and one Student's t for all programs.
#pragma once

#include <cstdint>

namespace ice {

/// Uncertainty of the model itself, as a share of the resistance [-]: stated, not computed. An
/// independent model of the same problem, convex solids with compliant contact, lay 3 to 12 % below
/// this one on the pre-sawn channel; see docs/limitations.md. It is shown beside intervals and
/// changes none.
inline constexpr double kModelUncertainty = 0.10;

/// Student's t [-] that a share `chance` of all exceed to either side together: 0.05 for 95 %.
/// `degrees` of freedom need not be whole. @pre degrees > 0, 0 < chance < 1
double student_quantile(double degrees, double chance);

/// Chance [-] that at least `count` of `trials` independent events of chance `each` happen
/// (binomial). @pre 0 < count <= trials, 0 < each < 1
double chance_of_at_least(std::int64_t count, std::int64_t trials, double each);

}  // namespace ice
