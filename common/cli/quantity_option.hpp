// SPDX-License-Identifier: GPL-3.0-or-later
/// Options with a unit: `-r "10 cm"`, `--checkpoint-every 5min`.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "common/base/units.hpp"

namespace ice {

/// Validators that leave a quantity in SI, a number that CLI11 reads; to be given to transform().
///
/// A bare number is SI. Refused are texts that parse_quantity() does not read, and numbers that are
/// not finite (or not above 0): CLI11's own checks let NaN pass and answer with 308 digits.
/// @param example  for the message: "2.5"
/// @param dimension  whose units are accepted
CLI::Validator positive_quantity(Dimension dimension, const std::string& example);
CLI::Validator finite_quantity(Dimension dimension, const std::string& example);

}  // namespace ice
