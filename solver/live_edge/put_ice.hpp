// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/scene/bodies.hpp"

namespace ice {

/// Gives a body another form and place: at rest, afloat level, with its centre of mass over `at`.
///
/// Momentum is zero, what was crushed of it is whole again, its moments of inertia are those of the
/// new form. The body's row of Scene::shapes and its row of inertias must be its own alone.
/// Bodies::moving is brought up to date.
///
/// @param density  [kg/m3]
/// @param share    of the form under water, > 0
void put_ice(Scene& scene, std::size_t body, Shape shape, const Eigen::Vector2d& at, double density,
             double share, bool held);

/// The form alone, of a body whose pose and momenta are known: for a run that is continued.
void put_form(Scene& scene, std::size_t body, Shape shape, double density);

}  // namespace ice
