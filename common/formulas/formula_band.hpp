// SPDX-License-Identifier: GPL-3.0-or-later
/// The values of all formulas for one ship and ice, and the band that they span.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/formats/particulars.hpp"
#include "common/formulas/spencer.hpp"

namespace ice {

/// Properties of ice that a case does not state: contract values, stated wherever they are used.
/// Lindqvist's crushing part is proportional to the strength, his bending part to the strength over
/// the root of the modulus. A larger Poisson's ratio makes the bending part a little smaller. A
/// larger strength also makes Jeong's breaking part larger; Riska's formula has none of the three.
inline constexpr double kFlexuralStrength = 5e5;  ///< [Pa]
inline constexpr double kElasticModulus = 5e9;    ///< [Pa]
inline constexpr double kPoissonRatio = 0.3;      ///< [-]

/// Names in FormulaValue: of Lindqvist's formula, and of any formula's total in level ice.
inline constexpr const char* kLindqvist = "Lindqvist 1989";
inline constexpr const char* kTotal = "total";

/// Inputs of the formulas that the user may give.
struct FormulaOptions {
    SpencerCoefficients spencer;
    /// [Pa], in place of the case's; NaN: the case's, and where that has none no level ice
    double flexural_strength = kUnknown;
};

/// Whether the run breaks level ice: its release rules have "until-bent".
bool is_level_ice(const IceParticulars& ice);

/// All parts that can be evaluated, in the order in which they are shown:
/// Lindqvist 1989: submersion; with a flexural strength crushing, bending, total.
/// Riska 1997 (with a strength, which says that there is level ice): total.
/// Jeong 2010, or the user's coefficients: buoyancy, clearing, "buoyancy + clearing"; with a
/// strength breaking, total. A part with an unknown input is left out.
/// @param speed  of the ship [m/s]; its size counts
/// @return values in [N]; empty where no formula has all inputs, as in 2D
std::vector<FormulaValue> evaluate_formulas(const ShipParticulars& ship, const IceParticulars& ice,
                                            double speed, const FormulaOptions& options = {});

/// The formulas that a run can be compared with: totals in level ice; in broken ice Lindqvist's
/// submersion, and the sum of buoyancy and clearing.
std::vector<FormulaValue> comparable_formulas(const std::vector<FormulaValue>& formulas,
                                              bool level_ice);

/// Least and largest of the values [N]; none without values.
struct FormulaBand {
    double low = 0.0, high = 0.0;
};
std::optional<FormulaBand> band_of(const std::vector<FormulaValue>& formulas);

/// The formulas with a part that no published number confirmed, by name, each with those parts.
std::vector<std::pair<std::string, std::string>> recalled_formulas(
    const std::vector<FormulaValue>& formulas);
inline constexpr const char* kRecalled = "recalled, compared with no published number";

/// The name of a formula's part in texts, e.g. "submersion part".
std::string part_text(const FormulaValue& formula);

}  // namespace ice
