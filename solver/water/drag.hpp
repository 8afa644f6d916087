// SPDX-License-Identifier: GPL-3.0-or-later
/// The water's drag on a body: docs/method.md, section 6.
#pragma once

#include "solver/shape/shape.hpp"

namespace ice {

/// Force and moment of the water on a body, world axes; the moment about the body origin.
struct WaterLoad {
    Vec3 force = Vec3::Zero();   ///< [N], 2D [N/m]: per metre of breadth
    Vec3 moment = Vec3::Zero();  ///< [N m], 2D [N]
};

/// Where a body is and how it moves relative to the water.
struct Motion {
    const Mat3& rotation;          ///< body to world
    double height;                 ///< z of the body origin [m]
    const Vec3& velocity;          ///< of the body origin less the water's, world axes [m/s]
    const Vec3& angular_velocity;  ///< world axes [rad/s]
};

/// The paper's drag (Eq. 9) on the wetted part, at the centre of gravity:
///
///     F = -1/2 rho_w C_d A |v| v,   A = sum over wetted facets of max(0, a . v / |v|)
///
/// (equation (16)) with a the facet's outward normal times its wetted area. A is the projected area
/// of a convex body; cavities count their facing walls as well. No moment. Zero at zero speed, and
/// for a body above the water. A force alone: the caller limits it (limit_drag) so that it never
/// reverses a motion.
/// @param coefficient    C_d [-]
/// @param water_density  rho_w [kg/m3]
WaterLoad projected_drag(const Shape& shape, const Motion& motion, double coefficient,
                         double water_density);

/// Drag of every piece of the wetted surface with its own velocity u = v + w x r, so that rotation
/// is damped too:
///
///     F = -1/2 rho_w C_d int max(0, n . u / |u|) |u| u dA,   moment = int r x dF,
///
/// equation (17), exactly, whatever the triangles. Zero for a body at rest or above the water.
/// Arguments as of projected_drag().
WaterLoad panel_drag(const Shape& shape, const Motion& motion, double coefficient,
                     double water_density);

/// Share of a triangle's area below z = 0 [-], from the heights of its corners [m] in any order;
/// continuous. 1 where all are at most 0, 0 where all are above.
double wetted_share(double z0, double z1, double z2);

}  // namespace ice
