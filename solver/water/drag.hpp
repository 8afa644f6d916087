// SPDX-License-Identifier: GPL-3.0-or-later
/// The water's drag on a body: docs/method.md, section 6.
#pragma once

#include "solver/shape/shape.hpp"

namespace ice {

/// Force and moment of the water on a body, world axes; the moment about the body origin.
struct WaterLoad {
    Vec3 force = Vec3::Zero();   ///< [N], 2D N per metre
    Vec3 moment = Vec3::Zero();  ///< [N m]
};

/// Where a body is and how it moves relative to the water.
struct Motion {
    const Mat3& rotation;          ///< body to world
    double height;                 ///< z of the body origin [m]
    const Vec3& velocity;          ///< [m/s]
    const Vec3& angular_velocity;  ///< [rad/s], world axes
};

/// The paper's drag (Eq. 9) on the wetted part, at the centre of gravity:
///
///     F = -1/2 rho_w C_d A |v| v,   A = sum over wetted facets of max(0, a . v / |v|)
///
/// a: facet's outward normal times wetted area. A is the projected area of a convex body; cavities
/// count their facing walls as well. Zero speed gives zero.
WaterLoad projected_drag(const Shape& shape, const Motion& motion, double coefficient,
                         double water_density);

/// The same law for every piece of the wetted surface with its own velocity u = v + w x r, so that
/// rotation is damped too:
///
///     F = -1/2 rho_w C_d int max(0, n . u / |u|) |u| u dA,   moment = int r x dF,
///
/// exactly, whatever the triangles.
WaterLoad panel_drag(const Shape& shape, const Motion& motion, double coefficient,
                     double water_density);

/// Share of a triangle's area below z = 0, from the heights of its corners; continuous.
double wetted_share(double z0, double z1, double z2);

}  // namespace ice
