// SPDX-License-Identifier: GPL-3.0-or-later
/// The contact stages of a step that was made, solved again: by us to rounding, and by Siconos.
#pragma once

#include <cstddef>

#include "solver/step/step.hpp"

namespace ice::oracle {

/// Impulses of the ice on the ship in one step, both stages [N s].
struct StepAgain {
    std::size_t contacts = 0;    ///< that carry an impulse in our solution to rounding
    std::size_t at_bound = 0;    ///< of these, crushing: Siconos gets their impulses from us
    Vec3 as_run, ours, siconos;  ///< the step as it was made; to rounding; by Siconos
    bool converged = false;      ///< of the step as it was made
    double error = 0.0;          ///< the larger of Siconos' residuals of the two stages [-]
};

/// @param before  the bodies before the step; held ones and the ship, too
/// @param after   the world after it
/// @param most    sweeps of Siconos at most [-]
/// @pre no restitution, no level ice, a ship on a prescribed course
StepAgain solve_again(const Bodies& before, const World& after, int most);

}  // namespace ice::oracle
