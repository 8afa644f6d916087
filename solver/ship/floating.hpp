// SPDX-License-Identifier: GPL-3.0-or-later
/// How a ship floats: the exact force of still water on it, its equilibrium and its stability
/// (docs/method.md, section 13).
#pragma once

#include "solver/ship/ship_body.hpp"

namespace ice {

/// Weight and buoyancy together, about the centre of gravity, world axes.
struct FloatingForce {
    double lift = 0.0;           ///< along z [N]
    Vec3 moment = Vec3::Zero();  ///< [N m]
    double volume = 0.0;         ///< submerged [m3]
};

/// By clipping the hull's mesh at the water, exactly at any attitude. Above the water the weight
/// alone is left.
/// @param rotation       ship to world
/// @param height         of the mesh's origin [m]
/// @param water_density  [kg/m3] @param gravity  [m/s2]
FloatingForce floating_force(const Shape& hull, const ShipBody& body, const Mat3& rotation,
                             double height, double water_density, double gravity);

/// m g z_G - rho g V (z + z_B) [J]: its slopes are those forces. Arguments as of floating_force().
double floating_energy(const Shape& hull, const ShipBody& body, const Mat3& rotation, double height,
                       double water_density, double gravity);

/// Equilibrium of a ship in the free motions, and the restoring forces about it.
struct Equilibrium {
    double height = 0.0;                     ///< of the mesh's origin [m]
    ShipAngles angles = ShipAngles::Zero();  ///< roll and pitch [rad]
    double volume = 0.0;                     ///< submerged [m3]
    SixNumbers stiffness{};  ///< of heave, roll and pitch by the water: C33, C44, C55 [N/m], [N m]
    double gm_transverse = 0.0, gm_longitudinal = 0.0;  ///< C / (m g) [m]
};

/// Finds it by Newton's steps from how the scene places the hull, to 1e-11 of the weight; motions
/// that are not free stay. Without such a free motion, or without gravity, the ship stays as it is
/// placed. A step is at most 0.1 rad and a tenth of the hull's depth.
/// @throws Error (exit code 2) where the ship capsizes, sinks, or no equilibrium is found
Equilibrium find_equilibrium(const Case& parameters, const Scene& scene, const ShipBody& body);

}  // namespace ice
