// SPDX-License-Identifier: GPL-3.0-or-later
/// Riska, Wilhelmson, Englund and Leiviska, "Performance of merchant vessels in ice in the Baltic",
/// Winter Navigation Research Board 52, 1997.
///
/// Range: merchant ships of the Baltic, by the title; lengths, thickness and speed of the source
/// not read by us. Totals of others were compared for one ship, MT Uikku, in ice of 0.76 to 1.04 m
/// at 0.2 to 1 m/s.
#pragma once

#include "common/formulas/level_ice.hpp"

namespace ice {

/// Resistance in level ice [N], in the source's units kN, m, m/s and phi in degrees:
///
///     R   = C_1 + C_2 V
///     C_1 = f_1 / (2 T/B + 1) B L_par h + (1 + 0.021 phi) (f_2 B h^2 + f_3 L_bow h^2
///           + f_4 B L_bow h)
///     C_2 = (1 + 0.063 phi) (g_1 h^1.5 + g_2 B h) + g_3 h (1 + 1.2 T/B) B^2 / sqrt(L)
///     f = 0.23, 4.58, 1.47, 0.29;  g = 18.9, 0.67, 1.55
///
/// For ships of the Baltic with a flexural strength of some 500 kPa, on which it does not depend.
/// Form and growth with h and V agree with values that others computed for one ship; the single
/// coefficients are recalled and tested by nothing. NaN where an input is unknown.
double riska_resistance(const HullDimensions& hull, const IceConditions& ice);

}  // namespace ice
