// SPDX-License-Identifier: GPL-3.0-or-later
/// Sums over the part of a surface that is under water, in body axes (docs/method.md, section 6).
#pragma once

#include "solver/shape/surface_blocks.hpp"

namespace ice {

/// Height of a point p of the body above the water: up . p + height [m]. The water is z = 0.
struct WaterPlane {
    Vec3 up;        ///< world z in body axes
    double height;  ///< of the body origin [m]

    /// @param rotation  body to world @param height_of_origin  over the water [m]
    WaterPlane(const Mat3& rotation, double height_of_origin)
        : up(rotation.row(2)), height(height_of_origin) {}
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
/// dry. No facets give zeros, nothing wet and nothing dry; the fill of the last block has no area.
/// Sums run in the facets' order over eight lanes, then over the lanes: the same bits everywhere.
WettedIntegrals integrate_wetted(const FacetBlocks& facets, const WaterPlane& water);

/// Integrals over the part of the wetted surface that a flow u meets, n . u > 0, with f = n . u.
struct FacingIntegrals {
    double flow = 0.0;           ///< int f dA [m3/s]
    Vec3 first = Vec3::Zero();   ///< int f p dA [m4/s]
    Vec3 square = Vec3::Zero();  ///< int f (x x, y y, z z) dA [m5/s]
    Vec3 mixed = Vec3::Zero();   ///< int f (x y, x z, y z) dA [m5/s]
};

/// Exactly, in a flow u = v + w x p, which makes f even on a triangle: f = n . v + p . (n x w).
/// With P, F and G the sums of p, f and f p over its corners,
///
///     int f dA     = A / 3 F,
///     int f p dA   = A / 12 (F P + G),
///     int f p p dA = A / 60 ((F P + G) P + P G + sum of (F + 2 f) p p).
///
/// Triangles, and tips that the water cuts off, are cut where f = 0 in the same way again. Zeros
/// where nothing is wet, or v and w are zero.
/// @param v  velocity of the body origin relative to the water, body axes [m/s]
/// @param w  angular velocity, body axes [rad/s]
FacingIntegrals integrate_facing(const FacetBlocks& facets, const WaterPlane& water, const Vec3& v,
                                 const Vec3& w);

/// int f dA alone, for w = 0 [m3/s]. @param v  body axes [m/s]
double integrate_facing(const FacetBlocks& facets, const WaterPlane& water, const Vec3& v);

/// Least product of two differences of height that a share is divided by, so that a triangle level
/// with the water to 1e-150 m has one, too [m2]. Any value that no real triangle reaches gives the
/// same results; 0 would give 0 / 0.
constexpr double kFlat = 1e-300;

namespace reference {
// The definitions, one facet at a time: read these first. Same bits on every instruction set.
WettedIntegrals integrate_wetted(const FacetBlocks& facets, const WaterPlane& water);
FacingIntegrals integrate_facing(const FacetBlocks& facets, const WaterPlane& water, const Vec3& v,
                                 const Vec3& w);
double integrate_facing(const FacetBlocks& facets, const WaterPlane& water, const Vec3& v);
}  // namespace reference

}  // namespace ice
