// SPDX-License-Identifier: GPL-3.0-or-later
/// Contacts solved by Siconos numerics: the oracle of our contact solver.
#pragma once

#include <span>
#include <vector>

#include "solver/contact/constraints.hpp"

namespace ice::oracle {

/// A solution of one stage's contact conditions.
struct ConeSolution {
    std::vector<Vec3> impulse;  ///< on b, by contact, world axes [N s]
    double error = 0.0;         ///< Siconos' own residual, relative to the free velocities [-]
    int iterations = 0;         ///< sweeps of nonsmooth Gauss-Seidel
};

/// Solves conditions (6) and (7) of docs/method.md for contacts without an upper bound, as the
/// friction problem "fc3d": impulses in Coulomb's cones, velocities (after De Saxce's change) in
/// their duals. The method is nonsmooth Gauss-Seidel with a Newton solution of each contact.
///
/// @param bodies    velocities before the stage; inverse masses with added mass. Read only
/// @param contacts  their impulses are not read; empty gives an empty solution
/// @param target    least normal velocity after the stage, by contact [m/s]
/// @param most      sweeps at most [-]
/// @pre each contact can move (Constraint::can_move); a ship on a prescribed course
ConeSolution solve_cones(const Bodies& bodies, std::span<const Constraint> contacts,
                         std::span<const double> target, int most);

}  // namespace ice::oracle
