// SPDX-License-Identifier: GPL-3.0-or-later
/// A ship's own coefficients of the component formula, as a TOML file.
#pragma once

#include <filesystem>
#include <string>

#include "common/formulas/spencer.hpp"

namespace ice {

/// Half widths of 95 % intervals of the coefficients of SpencerCoefficients, all [-]; NaN: not
/// fitted, or unknown.
struct CoefficientIntervals {
    double buoyancy = std::numeric_limits<double>::quiet_NaN();           ///< of C_B [-]
    double clearing = std::numeric_limits<double>::quiet_NaN();           ///< of C_C [-]
    double clearing_exponent = std::numeric_limits<double>::quiet_NaN();  ///< of a [-]
    double breaking = std::numeric_limits<double>::quiet_NaN();           ///< of C_BR [-]
    double breaking_exponent = std::numeric_limits<double>::quiet_NaN();  ///< of b [-]
};

/// Reads
///
///     [spencer]
///     name = "our ship"          # default: the file's name
///     c_b = 0.5                  # 0 or more, as c_c and c_br
///     c_c = 1.11
///     exponent = 1.157           # of the Froude number
///     c_br = 2.73                # default: Jeong's
///     breaking_exponent = 1.54   # likewise
///
/// A table [uncertainty] with the same names, as write_coefficients() makes it, is for people.
/// @throws Error (exit code 2) with all mistakes: file, line, key
SpencerCoefficients read_coefficients(const std::filesystem::path& file);

/// The file's text, for read_coefficients(), with the known intervals.
/// @param origin  of the numbers, for a comment
std::string coefficients_text(const SpencerCoefficients& coefficients,
                              const CoefficientIntervals& intervals, const std::string& origin);

}  // namespace ice
