// SPDX-License-Identifier: GPL-3.0-or-later
/// Inputs of the formulas for the resistance in level ice. SI units, angles in radians.
#pragma once

#include <limits>

namespace ice {

/// Hull dimensions at calm water.
struct HullDimensions {
    double length = 0.0;          ///< L, at the waterline [m]
    double breadth = 0.0;         ///< B, at the waterline [m]
    double draught = 0.0;         ///< T [m]
    double stem_angle = 0.0;      ///< phi, of the bow's centre line from the horizontal [rad]
    double entrance_angle = 0.0;  ///< alpha, half angle of the waterline at the bow [rad]
                                  ///< both angles NaN where the bow has no point
    /// Lengths of the waterline [m]: L_par of full breadth, L_bow before it; NaN where unknown
    double parallel_length = std::numeric_limits<double>::quiet_NaN();
    double bow_length = std::numeric_limits<double>::quiet_NaN();
};

/// The ice, the water, and the ship's way through both.
struct IceConditions {
    double thickness;      ///< h [m]
    double friction;       ///< mu, hull on ice [-]
    double ice_density;    ///< rho_i [kg/m3]
    double water_density;  ///< rho_w [kg/m3]
    double gravity;        ///< g [m/s2]
    double speed;          ///< V >= 0 [m/s]
    /// sigma_f [Pa], E [Pa] and nu [-] of level ice; NaN: broken ice
    double flexural_strength = std::numeric_limits<double>::quiet_NaN();
    double elastic_modulus = std::numeric_limits<double>::quiet_NaN();
    double poisson_ratio = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace ice
