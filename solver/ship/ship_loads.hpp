// SPDX-License-Identifier: GPL-3.0-or-later
/// Forces on a free ship other than the ice's (docs/method.md, section 13).
#pragma once

#include "solver/ship/floating.hpp"
#include "solver/ship/thrust.hpp"

namespace ice {

/// A force on the ship and its moment about the centre of gravity, world axes [N], [N m].
struct ShipForce {
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();

    ShipForce& operator+=(const ShipForce& other) {
        force += other.force;
        moment += other.moment;
        return *this;
    }
};

/// The parts of it in a step.
struct ShipLoads {
    ShipForce water;         ///< weight and buoyancy
    ShipForce propulsion;    ///< thrust, and the moment that holds the heading
    ShipForce tow, mooring;  ///< of the lines
    ShipForce losses;        ///< resistance in open water and linear damping
    ShipForce gyroscopic;    ///< -w x (I + A') w of (S1), a moment
    double thrust = 0.0;     ///< along the heading [N]

    ShipForce total() const;
};

/// Where a ship is and how it moves.
struct ShipState {
    Vec3 position = Vec3::Zero();            ///< of the mesh's origin [m]
    ShipAngles angles = ShipAngles::Zero();  ///< [rad]
    Vec3 velocity = Vec3::Zero();            ///< of the centre of gravity [m/s]
    Vec3 angular_velocity = Vec3::Zero();    ///< world axes [rad/s]
    double time = 0.0;                       ///< [s]
};

/// Reference state and scales of the loads; constant.
struct ShipRig {
    ShipBody body;
    Equilibrium equilibrium;
    SixNumbers damping{};        ///< [N s/m], [N m s]
    Vec3 anchor = Vec3::Zero();  ///< centre of gravity at the start [m]
    ShipAngles anchor_angles = ShipAngles::Zero();
    Vec3 towed_from = Vec3::Zero();  ///< the towed point at the start [m]
    /// [s]: speed hold gives T_P = m (e / tau + int e dt / (4 tau^2)), e = hold_speed - U,
    /// heading hold with 2 omega I dpsi/dt + omega^2 I psi, omega = 1 / (4 tau): both without
    /// overshoot. tau = sqrt(length / (9.81 m/s2)): a choice, which a mean does not depend on.
    double control_time = 1.0;
};

/// Masses, equilibrium and damping of a case's ship.
/// @throws Error (exit code 2) where it does not float, or the time step is too long for a spring
ShipRig make_ship_rig(const Case& parameters, const Scene& scene);

/// All but the damping, which the step takes in its middle.
/// @param current      of the water [m/s]
/// @param speed_error  int (hold_speed - U) dt so far [m]; 0 without a speed hold
ShipLoads measure_ship_loads(const Case& parameters, const Shape& hull, const ShipRig& rig,
                             const ShipState& state, const Vec3& current, double speed_error);

}  // namespace ice
