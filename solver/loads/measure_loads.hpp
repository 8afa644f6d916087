// SPDX-License-Identifier: GPL-3.0-or-later
/// Loads change velocities (docs/method.md, sections 2 and 6).
#pragma once

#include <vector>

#include "solver/loads/load_floes.hpp"

namespace ice {

/// Gravity, buoyancy and drag on every free floe, force and moment about the centre of mass, in the
/// order of Bodies::moving. In 2D only x, z and the moment about y act. @param out  resized
void measure_loads(const Scene& scene, const Case& parameters, std::vector<FloeLoad>& out);

/// Adds the caller's own loads to those measured. Floes whose load is zero keep their bits.
/// @param applied  by body, force and moment about the centre of mass in world axes; empty: none.
///                 Of the ship and of held floes nothing is taken.
/// @pre applied has one entry per body, or is empty and was so in all steps before; in 2D x, z and
///      the moment about y alone
void add_applied(const Bodies& bodies, const std::vector<WaterLoad>& applied,
                 std::vector<FloeLoad>& loads);

/// Loads by body: zero for held floes and the ship.
/// @pre no floe was released since measure_loads: a precondition of every function that takes
/// `loads`
std::vector<FloeLoad> loads_by_body(const Bodies& bodies, const std::vector<FloeLoad>& loads);

/// Velocities after the loads act for dt: v += F dt / m (with added mass (m + A)^-1 F dt),
/// w += I^-1 T dt. @param loads  by Bodies::moving @param dt  [s]
void apply_loads(Bodies& bodies, const std::vector<FloeLoad>& loads, double dt);

}  // namespace ice
