// SPDX-License-Identifier: GPL-3.0-or-later
/// Lindqvist's empirical resistance of level ice, submersion part: the yardstick beside our mean.
#pragma once

#include <optional>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// Hull dimensions at calm water, measured from the mesh.
struct HullForm {
    double length = 0.0;          ///< L, at the waterline [m]
    double breadth = 0.0;         ///< B, at the waterline [m]
    double draught = 0.0;         ///< T [m]
    double stem_angle = 0.0;      ///< phi, of the bow's centre line from the horizontal [rad]
    double entrance_angle = 0.0;  ///< alpha, half angle of the waterline at the bow [rad]
                                  ///< both NaN where the bow has no point
};

/// Measures L, B, T, phi and alpha.
///
/// The waterline is the mesh's section at `waterline` (ship frame). phi: slope of the foremost
/// points of the sections there and 0.1 T deeper. alpha: from the stem to where the waterline
/// reaches a quarter of the breadth.
/// @return nothing when the hull does not cross the water
std::optional<HullForm> measure_hull_form(const TriangleMesh& hull, double waterline);

struct IceConditions {
    double thickness;      ///< h [m]
    double friction;       ///< mu, hull on ice
    double ice_density;    ///< [kg/m3]
    double water_density;  ///< [kg/m3]
    double gravity;        ///< [m/s2]
    double speed;          ///< V [m/s]
};

/// Submersion resistance [N], Lindqvist, "A straightforward method for calculation of ice
/// resistance of ships", POAC 1989: with psi = arctan(tan phi / sin alpha),
///
///     R_s0 = (rho_w - rho_i) g h B [ T (B + T) / (B + 2 T) + mu ( 0.7 L - T / tan phi
///            - B / (4 tan alpha) + T cos phi cos psi sqrt(1 / sin^2 phi + 1 / tan^2 alpha) ) ]
///     R_s  = R_s0 (1 + 9.4 V / sqrt(g L))
///
/// NaN for a hull whose angles are.
double lindqvist_submersion(const HullForm& hull, const IceConditions& ice);

}  // namespace ice
