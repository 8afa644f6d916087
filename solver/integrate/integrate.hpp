// SPDX-License-Identifier: GPL-3.0-or-later
/// Loads change momenta; momenta move bodies (docs/method.md, section 2).
#pragma once

#include <vector>

#include "solver/case/case.hpp"
#include "solver/integrate/advance_floes.hpp"
#include "solver/integrate/load_floes.hpp"
#include "solver/scene/bodies.hpp"

namespace ice {

/// Gravity, buoyancy and drag on every free floe, force and moment about the centre of mass, in the
/// order of Bodies::moving. In 2D only x, z and the moment about y act.
void measure_loads(const Scene& scene, const Case& parameters, std::vector<FloeLoad>& out);

/// Adds the caller's own loads to those measured. Floes whose load is zero keep their bits.
/// @param applied  by body, force and moment about the centre of mass in world axes; empty: none.
///                 Of the ship and of held floes nothing is taken.
/// @pre applied has one entry per body, or is empty and was so in all steps before; in 2D x, z and
///      the moment about y alone
void add_applied(const Bodies& bodies, const std::vector<WaterLoad>& applied,
                 std::vector<FloeLoad>& loads);

/// Loads by body: zero for held floes and the ship.
/// @pre no floe was released since measure_loads; so for all that take its answer
std::vector<FloeLoad> loads_by_body(const Bodies& bodies, const std::vector<FloeLoad>& loads);

/// Velocities after the loads act for dt: v += F dt / m, w += I^-1 T dt.
void apply_loads(Bodies& bodies, const std::vector<FloeLoad>& loads, double dt);

/// Moves all bodies by a step: the ship with its velocity, floes that are not held as advance_floes
/// does.
void advance(Scene& scene, const Advance& step);

/// Kinetic energy of the free floes [J]: sum of P.v/2 + L.w/2.
double kinetic_energy(const Bodies& bodies);

/// Potential energy of all floes, held ones too, in weight and water [J]:
///
///     U = sum m g z - rho_w g V (z + z_B),
///
/// V the submerged volume and z_B the height of its centre above the floe's origin: pushing a piece
/// of volume under to a depth d lifts as much water by d. -dU/dz is weight plus buoyancy, and the
/// derivative by rotation the moment of "distributed" buoyancy. Without buoyancy only m g z.
double potential_energy(const Scene& scene, const Case& parameters);

}  // namespace ice
