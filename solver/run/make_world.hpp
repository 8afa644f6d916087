// SPDX-License-Identifier: GPL-3.0-or-later
/// Worlds made in code, without files: the solver as a library (docs/library.md).
#pragma once

#include "common/formats/sphere_set.hpp"
#include "solver/record/measure_step.hpp"
#include "solver/scene/build_scene.hpp"
#include "solver/step/step.hpp"

namespace ice {

/// A world with the ship alone; add_floe_shape() and add_floe() bring the ice, step() moves it.
///
/// @param parameters  as of a case file, in SI: time_step, the ship's place and speed_table (empty:
///                    at rest), contact law, water. `floes` and `hull_spheres` are ignored.
///                    A duration is needed for run() only.
/// @param hull        in the ship frame
/// @throws Error (exit code 2) when time_step, densities or speed_table cannot be, or the hull is
///         of another dimension
World make_world(const Case& parameters, const SphereSet& hull);

/// Adds a shape that floes can share.
/// @return its number for add_floe()
/// @throws Error (exit code 2) when it is of another dimension than the world
std::int32_t add_floe_shape(World& world, const SphereSet& floe);

/// Adds a floe of that shape with the case's ice density.
/// @pre no step has been made yet
/// @return its number, from 1: its row in world.scene.bodies
/// @throws Error (exit code 2) for an unknown shape, or ice that does not float where no z is given
std::size_t add_floe(World& world, std::int32_t shape, const FloeStart& start);

/// Forces of the ice on the ship in the last step.
StepRecord measure_step(const World& world);

}  // namespace ice
