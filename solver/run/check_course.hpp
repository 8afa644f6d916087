// SPDX-License-Identifier: GPL-3.0-or-later
/// Checks before the first step whether the ship meets the ice of a case, and for how long.
#pragma once

#include <optional>
#include <vector>

#include "common/formats/warning.hpp"
#include "solver/step/step.hpp"

namespace ice {

/// The ship's course through the ice as it lies at the start. Infinite where no ice lies in its
/// path, or the time is not reached.
struct Course {
    double travel = 0.0;           ///< along the course, over the whole run [m], >= 0
    double clearance = 0.0;        ///< to the first ice in the path [m]
    double clearance_fixed = 0.0;  ///< to the first unbroken ice in the path [m]
    double meets_at = 0.0;         ///< when the ship meets the first ice [s]
    double hits_fixed_at = 0.0;    ///< when it meets unbroken ice [s]
    double through = 0.0;          ///< until its foremost point is beyond all loose floes [m]
    double leaves_at = 0.0;        ///< when its foremost point is beyond all loose floes [s]
    bool beside = false;           ///< level ice: whether the ship passes beside the sheet
};

/// Measures the course from the contact spheres: ice lies in the path where the hull's cross
/// section, in cells of one sphere spacing, passes over it. Distances are right to about a spacing.
/// Loose floes beyond which the ship "leaves" are those within its breadth.
Course measure_course(const World& world);

/// Warns of a ship that never meets the ice, meets it after the averages began, leaves it before
/// they end, or runs into unbroken ice, and of a ship on a prescribed course at rest in ice and
/// water at rest. No warning for a ship whose path ends where it began, or if floes have velocities
/// of their own.
std::vector<Warning> check_course(const World& world);

/// Warns of averages over less than a ship's length, with the duration that makes it one; under the
/// same conditions. It has no verdict: the run's summary states the effect on the mean
/// (RunStatistics).
std::optional<Warning> warn_of_short_averages(const World& world);

}  // namespace ice
