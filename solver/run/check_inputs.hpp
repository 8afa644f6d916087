// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "common/formats/warning.hpp"
#include "solver/case/case.hpp"

namespace ice {

/// Looks for numbers that no ice has, most of them in a wrong unit ("1" Pa for 1 MPa): a density
/// outside 850 to 940 kg/m3; a finite crushing pressure outside 10 kPa to 100 MPa; where ice bends,
/// a flexural strength outside 10 kPa to 10 MPa and a modulus outside 0.5 to 12 GPa. The ranges
/// include the ice of model basins, whose modulus is 1 MPa or more.
/// @return a warning for each, which names the unit that may be meant. Its share of the mean is how
///         far the number is outside, since no force grows faster than these numbers: the weight in
///         water for a density
std::vector<Warning> check_inputs(const Case& parameters);

}  // namespace ice
