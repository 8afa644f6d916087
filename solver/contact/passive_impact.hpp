// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solver/contact/constraints.hpp"

namespace ice {

/// The velocities and impact impulses of a solution of the impact stage.
struct ImpactState {
    std::vector<Vec3> velocity, angular_velocity;  ///< per body
    std::vector<double> normal;                    ///< per constraint [N s]
    std::vector<Vec3> tangent;

    void save(const Bodies& bodies, const std::vector<Constraint>& constraints);
    void restore(Bodies& bodies, std::vector<Constraint>& constraints) const;
};

/// Energy [J] that the impacts put into the floes beyond the ship's work, largest of all islands
/// (floes connected by contacts); at most 0 for impacts that only lose energy.
///
/// With v_r at the constraints before (from `start`) and now, the sum of
/// J . (v_r before + v_r now) / 2 over an island's constraints.
double energy_gain(const Bodies& bodies, const std::vector<Constraint>& constraints,
                   const ImpactState& start);

/// Takes as much of the rebound away as keeps every island from gaining energy.
///
/// Newton's restitution fixes normal speeds whatever work friction does meanwhile, and may add
/// energy in oblique impacts (Kane and Levinson, Dynamics, 1985). The solution without rebound
/// never does, and any mixture of the two keeps contacts closed, cones and bounds: per island
///
///     J = J_plastic + s (J_rebound - J_plastic),   s in [0, 1] the largest with gain <= 0.
///
/// On entry bodies and constraints hold the solution with rebound, on return the mixture.
void limit_rebound(Bodies& bodies, std::vector<Constraint>& constraints, const ImpactState& start,
                   const ImpactState& plastic);

}  // namespace ice
