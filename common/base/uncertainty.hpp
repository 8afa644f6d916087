// SPDX-License-Identifier: GPL-3.0-or-later
/// How well a mean is known: one model uncertainty and one Student's t for all programs.
#pragma once

#include <cstdint>

namespace ice {

/// Uncertainty of the model itself in broken ice, as a share of the resistance [-]: stated, not
/// computed. An independent model of the same problem, convex solids with compliant contact, lay 3
/// to 12 % below this one on the pre-sawn channel; see docs/limitations.md. It is shown beside
/// intervals and changes none.
inline constexpr double kModelUncertainty = 0.10;

/// Errors of the mean in level ice, as shares of the measured resistance [-]: least and largest of
/// the mean absolute errors over the groups of model tests with MT Uikku, and the bias over the
/// seven tests of sheets I to III; see docs/validation-measured.md, whose tables a test compares
/// with these. They take the place of kModelUncertainty where the ship breaks the ice, and change
/// no number either.
inline constexpr double kLeastLevelIceError = 0.06;
inline constexpr double kLargestLevelIceError = 0.45;
inline constexpr double kLevelIceBias = 0.07;

/// Student's t [-] that a share `chance` of all exceed to either side together: 0.05 for 95 %.
/// `degrees` of freedom need not be whole. @pre degrees > 0, 0 < chance < 1
double student_quantile(double degrees, double chance);

/// Chance [-] that at least `count` of `trials` independent events of chance `each` happen
/// (binomial). @pre 0 < count <= trials, 0 < each < 1
double chance_of_at_least(std::int64_t count, std::int64_t trials, double each);

}  // namespace ice
