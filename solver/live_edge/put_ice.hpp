// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/scene/bodies.hpp"

namespace ice {

/// How ice is put into a scene.
struct PutIce {
    Eigen::Vector2d at;        ///< of its centre of mass [m]
    Eigen::Vector2d velocity;  ///< [m/s]
    double density;            ///< [kg/m3]
    double share;              ///< of the shape's volume under water [-], > 0, at most 1
    bool held;
};

/// Gives a body another shape and place: afloat level, without spin.
///
/// Its crushed depths are 0 again, its moments of inertia are those of the new shape. The body's
/// row of Scene::shapes and its row of inertias must be its own alone. Bodies::moving is brought up
/// to date.
void put_ice(Scene& scene, std::size_t body, Shape shape, const PutIce& as);

/// The shape alone, of a body whose pose and momenta are known: for a run that is continued.
/// @param density  [kg/m3]
void put_shape(Scene& scene, std::size_t body, Shape shape, double density);

}  // namespace ice
