// SPDX-License-Identifier: GPL-3.0-or-later
/// The submerged part of a floe: volume, centre of buoyancy, floating equilibrium
/// (docs/method.md, section 6).
#pragma once

#include <Eigen/Geometry>

#include "solver/shape/shape.hpp"

namespace ice {

/// The part of a body below z = 0.
struct Submerged {
    double volume = 0.0;         ///< [m3], 2D per metre of breadth
    Vec3 centre = Vec3::Zero();  ///< of that volume, relative to the body origin, world axes [m]
};

/// Submerged volume and its centre, exactly.
///
/// By the divergence theorem with the field (0, 0, z) times 1, x, y, z/2, whose flux through the
/// water plane z = 0 vanishes, only the wetted surface S counts (n its outward normal):
///
///     V       = int_S z n_z dA
///     V x_c   = int_S x z n_z dA,  V y_c likewise,  V z_c = int_S z^2 / 2 n_z dA
///
/// Triangles that cross the surface are clipped. A body wholly below or above costs no triangles.
/// Continuous in the pose: no steps when an edge crosses the surface.
///
/// (equation (14)). Zeros for a body above the water, and where a corner dips in by less than
/// rounding; the solid's own volume and centroid below it.
/// @param rotation  body to world
/// @param height    z of the body origin [m]
Submerged measure_submerged(const Shape& shape, const Mat3& rotation, double height);

/// z of the body origin [m] at which the submerged volume is `fraction` [-] of the whole,
/// orientation given; bisection to 1e-12 of the body's height.
/// @pre 0 < fraction; a fraction of 1 or more gives the height at which the top just submerges.
double floating_height(const Shape& shape, const Mat3& rotation, double fraction);

}  // namespace ice
