// SPDX-License-Identifier: GPL-3.0-or-later
/// Floes that move water along.
#pragma once

#include "solver/case/case.hpp"
#include "solver/flow/added_mass.hpp"
#include "solver/scene/bodies.hpp"

namespace ice {

/// Gives the floes of a scene, but those held for good, the added mass of their shapes in deep
/// water (equation (P2)): translation in Inertia::added, rotation in Inertia::body. The coupling of
/// both about the centre of mass is left out: docs/method.md, section 6. Velocities stay, momenta
/// become those of floe and water. Each shape is computed once.
/// @pre 3D; all floes are there, pieces of level ice that break off later get theirs by add_water()
/// @throws Error (exit code 1) where the flow around a shape has no solution
void set_added_mass(Scene& scene, const Case& parameters);

/// Adds that of one body's shape to its row of inertias, which others may share: once for each row.
/// Its momenta are not touched. @param water_density  [kg/m3]
void add_water(Scene& scene, std::size_t body, double water_density);

/// Added mass of one shape in deep water about its origin, from some 400 panels or as many as its
/// mesh has triangles: [kg] and [kg m2] (added_mass()).
/// @param mesh  closed, about the centre of mass [m]
/// @param water_density  [kg/m3]
Mat6 added_mass_of_shape(const TriangleMesh& mesh, double water_density);

}  // namespace ice
