// SPDX-License-Identifier: GPL-3.0-or-later
/// Lindqvist, "A straightforward method for calculation of ice resistance of ships", POAC 1989.
///
/// Range (ships, thickness, speed of the source): not read by us. Totals of others were compared
/// for one ship of 118 x 21.5 x 7.5 m in ice of 0.95 to 1.65 m at 0.7 to 3.8 m/s.
#pragma once

#include "common/formulas/level_ice.hpp"

namespace ice {

/// Submersion resistance [N]: with psi = arctan(tan phi / sin alpha),
///
///     R_s0 = (rho_w - rho_i) g h B [ T (B + T) / (B + 2 T) + mu ( 0.7 L - T / tan phi
///            - B / (4 tan alpha) + T cos phi cos psi sqrt(1 / sin^2 phi + 1 / tan^2 alpha) ) ]
///     R_s  = R_s0 (1 + 9.4 V / sqrt(g L))
///
/// NaN for a hull whose angles are.
double lindqvist_submersion(const HullDimensions& hull, const IceConditions& ice);

/// The parts of the resistance in level ice [N], each with its speed factor.
struct LindqvistParts {
    double crushing = 0.0, bending = 0.0, submersion = 0.0;
    double total() const { return crushing + bending + submersion; }
};

/// All parts:
///
///     R_c0 = 0.5 sigma_f h^2 (tan phi + mu cos phi / cos psi) / (1 - mu sin phi / cos psi)
///     R_b0 = 27/64 sigma_f B h^1.5 / sqrt(E / (12 (1 - nu^2) rho_w g))
///            (tan psi + mu cos phi / (sin alpha cos psi)) (1 + 1 / cos psi)
///     R    = (R_c0 + R_b0) (1 + 1.4 V / sqrt(g h)) + R_s
///
/// The prefactor 27/64 and the brackets of R_b0 are recalled, not read in the paper; another
/// publication prints 37/64. Six values that others computed for one hull (E 9 GPa assumed) are met
/// within 14 %. NaN where an input is, and for a bow so steep and rough that it cannot crush ice
/// (mu sin phi >= cos psi).
LindqvistParts lindqvist_resistance(const HullDimensions& hull, const IceConditions& ice);

}  // namespace ice
