// SPDX-License-Identifier: GPL-3.0-or-later
/// Conservation of momentum, checked from outside the step: not a part of the method.
#pragma once

#include <vector>

#include "solver/step/step.hpp"

namespace ice {

/// Rounding of a step: an impulse is the sum of up to thousands of small changes, each exact to
/// 1e-16 of the velocity it meets. On the paper's cases the worst step is off by 1e-13. A share of
/// the terms' magnitudes [-]; less stops runs for rounding, more lets small faults pass.
constexpr double kBalanceTolerance = 1e-12;

/// State that a step changes.
struct Momenta {
    /// By body, as in Bodies: places [m], P [kg m/s], L [kg m2/s].
    std::vector<Vec3> position, linear, angular;
    ShipAngles ship_angles = ShipAngles::Zero();  ///< roll, pitch, yaw [rad]
};

/// The imbalance of a step, as a share of the magnitudes that should cancel [-].
struct Imbalance {
    double linear = 0.0;    ///< of the worst floe: change of P against loads and contact impulses
    double angular = 0.0;   ///< of the worst floe: change of L against the moments
    double together = 0.0;  ///< momentum that all floes gained beyond the loads, against the forces
                            ///< reported for the ship and the impulses on held floes
    double ship = 0.0;      ///< momentum that a free ship gained beyond its own loads, against
                            ///< those forces; 0 for a prescribed course
    std::int32_t linear_floe = 0, angular_floe = 0;  ///< the worst ones; 0 where there is none

    /// The largest of them [-].
    double worst() const;
};

/// To be taken before a step, and after begin_step() where there is level ice. Held floes count
/// with the momentum they will be released with.
Momenta momenta_of(const World& world);

/// Compares a step with the momenta before it. For every free floe, with F, T the water's loads and
/// gravity and J the contact impulses on it at p:
///
///     P' - P = dt F + sum J,      L' - L = dt T + sum (p - x) x J,
///
/// and for all of them, with the force f and the moment reported for the ship (measure_step) and
/// the impulses J_h on floes still held, about the world's origin at the start of the step,
///
///     sum (P' - P - dt F) + dt f_ship + sum J_h = 0,   likewise for the moments.
///
/// A free ship has in its free motions, with the matrix of (S1) at the step's start and F_s
/// of thrust, lines and water,
///
///     (M + A) (v' - v) = dt F_s + dt f_ship,
///
/// likewise for the moments about its centre of gravity. With the sum above that is: loads, thrust,
/// lines, held ice and the constraints of locked motions change the momentum of ship and floes, and
/// nothing else does.
///
/// Each residual is divided by the sum of the magnitudes of its terms; 2D compares x, z and the
/// moment about y only.
Imbalance measure_imbalance(const Momenta& before, const World& after);

/// Measures the imbalance, and stops the run when it is beyond kBalanceTolerance.
/// @throws Error (exit code 1) naming step and floe
Imbalance require_balance(const Momenta& before, const World& after);

}  // namespace ice
