// SPDX-License-Identifier: GPL-3.0-or-later
/// The load that breaks a piece off, from its form and the case (docs/method.md, section 5).
#pragma once

#include "common/geometry/triangle_mesh.hpp"
#include "solver/case/case.hpp"

namespace ice {

/// A piece as it lies, seen from above.
struct PieceOutline {
    double chord;      ///< largest distance of two of its points [m]
    double depth;      ///< extent across the chord [m]
    double thickness;  ///< extent along z [m]
};

/// Measures a piece in the attitude `rotation`, body to world. @pre the mesh has vertices
PieceOutline measure_outline(const TriangleMesh& mesh, const Mat3& rotation);

/// Angle under which the chord is seen from the piece's depth [rad]: 2 atan(chord / (2 depth)),
/// the wedge that the piece stands for; pi where the piece has no depth.
double opening_angle(const PieceOutline& piece);

/// Downward load that breaks the piece off [N], with bending.factor but not its table; in 2D the
/// beam's [N/m].
double breaking_load(const PieceOutline& piece, const Case& parameters);

/// bending.factor_table at a normal speed [m/s], linear between its rows and constant outside; 1
/// without a table.
double speed_factor(const BendingLaw& law, double normal_speed);

}  // namespace ice
