// SPDX-License-Identifier: GPL-3.0-or-later
/// Sums over the part of a surface that is under water, in body axes.
#pragma once

#include <cmath>

#include "solver/shape/surface_blocks.hpp"

namespace ice {

/// Height of a point p of the body above the water: up . p + height [m].
struct WaterPlane {
    Vec3 up;        ///< world z in body axes
    double height;  ///< of the body origin [m]
    double margin;  ///< more than heights are rounded by [m]

    /// For a body of at most this radius about its origin; rotation: body to world.
    WaterPlane(const Mat3& rotation, double height_of_origin, double radius)
        : up(rotation.row(2)),
          height(height_of_origin),
          margin(1e-12 * (radius + std::abs(height))) {}
};

/// Integrals over the wetted surface S, z the height, n the outward normal and n_z its world z.
struct WettedIntegrals {
    double volume = 0.0;        ///< int_S z n_z dA [m3]
    Vec3 first = Vec3::Zero();  ///< int_S p z n_z dA, p in body axes [m4]
    bool any_wet = false;       ///< a corner lies at z <= 0
    bool any_dry = false;       ///< a corner lies at z > 0
};

/// Exactly, a triangle with corners z <= 0 and z > 0 being cut. With A its projection on the water,
///
///     int z n_z dA   = A / 3 sum z,
///     int p z n_z dA = A / 12 (sum p sum z + sum of p z),
///
/// sums over the three corners. The one corner whose side differs from the others', p0, is the apex
/// of a tip with the others at z = 0: the tip counts where p0 is wet, all but the tip where it is
/// dry.
WettedIntegrals integrate_wetted(const PanelBlocks& facets, const WaterPlane& water);

/// Sums over panels of f, the flow that meets the wetted part of each.
struct FacingSums {
    double flow = 0.0;           ///< sum of f [m3/s]
    Vec3 first = Vec3::Zero();   ///< sum of f c [m4/s]
    Vec3 square = Vec3::Zero();  ///< sum of f (x x, y y, z z) [m5/s]
    Vec3 mixed = Vec3::Zero();   ///< sum of f (x y, x z, y z) [m5/s]
};

/// Least product of two differences of height that a share is divided by, so that a triangle level
/// with the water to 1e-150 m has one, too [m2].
constexpr double kFlat = 1e-300;

/// With the panels' centres c, area vectors a and wetted shares s, in a flow v + w x c:
///
///     f = s max(0, a . (v + w x c)) = s max(0, a . v + (c x a) . w).
FacingSums sum_facing(const PanelBlocks& panels, const WaterPlane& water, const Vec3& v,
                      const Vec3& w);

/// The sum of f alone, for w = 0 [m3/s].
double sum_facing(const PanelBlocks& panels, const WaterPlane& water, const Vec3& v);

namespace reference {
// The definitions, one panel at a time: read these first. Same bits on every instruction set.
WettedIntegrals integrate_wetted(const PanelBlocks& facets, const WaterPlane& water);
FacingSums sum_facing(const PanelBlocks& panels, const WaterPlane& water, const Vec3& v,
                      const Vec3& w);
double sum_facing(const PanelBlocks& panels, const WaterPlane& water, const Vec3& v);
}  // namespace reference

}  // namespace ice
