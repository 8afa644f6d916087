// SPDX-License-Identifier: GPL-3.0-or-later
/// The load that breaks a piece off, from its shape and the case (docs/method.md, section 5).
#pragma once

#include "common/geometry/triangle_mesh.hpp"
#include "solver/bending/ice_plate.hpp"
#include "solver/case/case.hpp"

namespace ice {

/// A case's ice as a plate of that thickness [m], > 0.
IcePlate plate_of(double thickness, const Case& parameters);

/// A piece as it lies, seen from above.
struct PieceOutline {
    double area;       ///< of its upper side, as a level projection [m2]
    double depth;      ///< extent across the largest distance of two of its points [m]
    double thickness;  ///< extent along z [m]
};

/// Measures a piece in the attitude `rotation`, body to world. Overhangs count twice in its area.
/// @pre the mesh is closed
PieceOutline measure_outline(const TriangleMesh& mesh, const Mat3& rotation);

/// Angle of the sector that has the piece's area and its depth as radius [rad]: 2 area / depth^2,
/// at most pi, which a half disc has; pi where the piece has no depth. Of a slender wedge with its
/// tip at the load it is the wedge's own angle.
double opening_angle(const PieceOutline& piece);

/// Downward load that breaks the piece off [N], with bending.factor but not its table; in 2D the
/// beam's [N/m]. Equations (28) and (29). bending.opening_angle wins over the piece's own angle.
double breaking_load(const PieceOutline& piece, const Case& parameters);

/// The breaking load [N] of a piece with the opening angle `angle` [rad], unless the case gives an
/// angle; in 2D the beam's [N/m], whatever the angle.
double breaking_load(double angle, double thickness, const Case& parameters);

/// bending.factor_table at a normal speed [m/s], f(v_n) [-]: linear between its rows and constant
/// outside; 1 without a table.
double speed_factor(const BendingLaw& law, double normal_speed);

}  // namespace ice
