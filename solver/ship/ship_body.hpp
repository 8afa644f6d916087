// SPDX-License-Identifier: GPL-3.0-or-later
/// The ship as a rigid body with the water that moves along: masses, axes, response to impulses.
#pragma once

#include <array>

#include "solver/case/case.hpp"
#include "solver/scene/bodies.hpp"

namespace ice {

/// One number for each motion, in the order of Freedom.
using SixNumbers = std::array<double, kFreedoms>;

/// Constants of a run.
struct ShipBody {
    std::array<bool, kFreedoms> free{};
    double mass = 0.0;            ///< [kg], 2D per metre of breadth
    Vec3 inertia = Vec3::Zero();  ///< about the centre of gravity, ship axes [kg m2]
    SixNumbers added{};           ///< added mass [kg] and inertia [kg m2], ship axes
    SixNumbers water_damping{};   ///< of ship.matrix, ship axes [N s/m], [N m s]
    double coupling = 0.0;  ///< largest_coupling() of mass and ship.matrix, which is left out [-]
    Vec3 centre_of_gravity = Vec3::Zero();  ///< ship frame [m]
    Vec3 gyration = Vec3::Zero();           ///< radii about the ship's x, y, z [m]

    bool any_free() const;
    bool turns() const { return free[roll] || free[pitch] || free[yaw]; }
    /// Does the water carry it in any motion?
    bool floats() const { return free[heave] || free[roll] || free[pitch]; }
};

/// Masses of the case's ship; values that it leaves open come from the hull of the scene.
///
/// Default mass: water_density times the submerged volume. Default centre of gravity: the centre of
/// buoyancy, so that the ship is upright as placed. Default radii of gyration: 0.35 of the box's
/// breadth, 0.25 of its length (usual shares; recall, not looked up). Computed added mass is the
/// diagonal of ship_added_mass() about the centre of gravity, upright at the height of the scene;
/// that of ship.matrix is the diagonal there as well.
/// @throws Error as ship_added_mass, read_ship_matrix
ShipBody make_ship_body(const Case& parameters, const Scene& scene);

/// Roll, pitch and yaw [rad]: R = R_z(yaw) R_y(pitch) R_x(roll). Positive pitch is bow down,
/// positive roll is port up, positive yaw is to port.
using ShipAngles = Vec3;

/// Orientation of a ship with these angles.
Quaternion orientation_of(const ShipAngles& angles);

/// Axes of the motions in the world: of surge, sway and heave in the columns of `translation` (they
/// turn with yaw alone), of roll, pitch and yaw in those of `rotation`. The angular velocity is
/// `rotation` times the rates of roll, pitch, yaw.
struct ShipAxes {
    Mat3 translation = Mat3::Identity(), rotation = Mat3::Identity();
};
ShipAxes axes_of(const ShipAngles& angles);

/// Mass matrices in those axes: generalised mass of translations [kg] and of rotations [kg m2].
struct ShipMasses {
    Mat3 translation, rotation;
};
ShipMasses masses_of(const ShipBody& body, const ShipAngles& angles);

/// The inverse on the free ones of three motions, zero in the others; all zero where none is free.
/// The unit is the inverse of the matrix's. @param first  surge or roll
Mat3 inverse_on_free(const Mat3& matrix, const ShipBody& body, Freedom first);

/// Response of the ship to impulses in that attitude: the inverses of (S1). @param angles  [rad]
ShipResponse response_of(const ShipBody& body, const ShipAngles& angles);

}  // namespace ice
