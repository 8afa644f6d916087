// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>

#include "common/geometry/mass_properties.hpp"

namespace ice {

/// A solid of one density as other programs want it: mass and principal axes.
struct RigidBody {
    double density = 0.0;             ///< [kg/m3]
    double volume = 0.0, mass = 0.0;  ///< [m3], [kg]
    Vec3 centroid = Vec3::Zero();     ///< in the mesh's frame [m]
    Mat3 inertia = Mat3::Zero();      ///< about the centroid, mesh axes, symmetric [kg m2]
    Vec3 moments = Vec3::Zero();      ///< principal moments, ascending [kg m2]
    /// Turns principal axes into mesh axes: inertia = R diag(moments) R^T; unit, w >= 0.
    Eigen::Quaterniond axes = Eigen::Quaterniond::Identity();
};

/// The exact integrals of a solid (never those of its spheres) at a density [kg/m3].
///
/// The axes are right-handed and the same on every call: the largest component of the first two is
/// positive, the third is their cross product. Products of inertia below 1e-14 of the trace are
/// the rounding of a symmetric solid and count as zero for the axes (not in `inertia`), so that a
/// box or a cube keeps the mesh's directions. Where moments are equal any axes would do.
///
/// @pre 3D integrals of positive volume; density > 0
RigidBody rigid_body(const MassProperties& solid, double density);

}  // namespace ice
