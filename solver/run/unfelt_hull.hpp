// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/scene/bodies.hpp"

namespace ice {

/// Part of the hull's surface that no contact sphere represents: ice enters it unfelt.
struct UnfeltHull {
    double area = 0.0;       ///< of the hull in the belt [m2]
    double share = 0.0;      ///< of it farther than a spacing from every sphere's seat and tip [-]
    Vec3 at = Vec3::Zero();  ///< the farthest place, ship frame [m]
    double distance = 0.0;   ///< from the nearest seat or tip there [m]
};

/// Looks at the hull's mesh between two heights, at points half a spacing apart.
///
/// A sphere represents the surface around its seat, half to two thirds of a spacing far, and the
/// tip of an edge or corner, if the sphere touches all its faces. A part thinner than a sphere (a
/// stem, a fin) has none. A hull outside the belt has no area and no share.
/// @param low, high  world heights of the belt [m]
UnfeltHull measure_unfelt_hull(const Scene& scene, double low, double high);

}  // namespace ice
