// SPDX-License-Identifier: GPL-3.0-or-later
/// Resistance by components, after Spencer (ATTC 1992) and Spencer and Jones (ISOPE 2001).
///
/// Range of Jeong's coefficients: model tests of one icebreaker, the standard one of MOERI; its
/// size, thickness and speed not read by us. Totals were compared for MT Uikku in ice of 0.76 to
/// 1.04 m at 0.2 to 1 m/s.
#pragma once

#include <string>

#include "common/formulas/level_ice.hpp"

namespace ice {

/// Coefficients of a ship. The default are those of Jeong and others (ISOPE 2010, model tests of an
/// icebreaker in level, pre-sawn and creeping pre-sawn ice), recalled. Values that were published
/// for MT Uikku in level ice are met within 1.3 %. That pins C_BR and b; C_C and a to 20 % only,
/// and C_B only as a product with density difference and draught.
struct SpencerCoefficients {
    std::string name = "Jeong 2010";
    double buoyancy = 0.5;             ///< C_B [-]
    double clearing = 1.11;            ///< C_C [-]
    double clearing_exponent = 1.157;  ///< a [-], below 2
    double breaking = 2.73;            ///< C_BR [-]
    double breaking_exponent = 1.54;   ///< b [-], below 2
    bool own = false;                  ///< of the user's own ship
};

/// The parts of the resistance [N]. Pre-sawn or broken ice has no breaking; a creeping ship in
/// pre-sawn ice buoyancy alone.
struct SpencerParts {
    double buoyancy = 0.0, clearing = 0.0, breaking = 0.0;
    double broken_ice() const { return buoyancy + clearing; }
    double total() const { return broken_ice() + breaking; }
};

/// Buoyancy, clearing and breaking:
///
///     R_B  = C_B (rho_w - rho_i) g h B T
///     R_C  = C_C Fr_h^-a rho_i B h V^2,   Fr_h = V / sqrt(g h)
///     R_BR = C_BR S^-b rho_i B h V^2,     S = V sqrt(rho_i B / (sigma_f h))
///
/// At V = 0 the last two are 0 (a, b < 2), as their limits are. Breaking is NaN without strength.
SpencerParts spencer_resistance(const HullDimensions& hull, const IceConditions& ice,
                                const SpencerCoefficients& coefficients = {});

/// The variables of the formula, by which a fit finds its coefficients.
struct SpencerScales {
    double weight = 0.0;  ///< (rho_w - rho_i) g h B T [N]
    /// rho_i B h V^2 [N], Fr_h [-], S [-]; S is NaN without strength
    double inertia = 0.0, froude = 0.0, strength = 0.0;
};
SpencerScales spencer_scales(const HullDimensions& hull, const IceConditions& ice);

}  // namespace ice
