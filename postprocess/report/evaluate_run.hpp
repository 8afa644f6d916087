// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/formats/summary_file.hpp"
#include "common/formulas/formula_band.hpp"

namespace ice::report {

/// Evaluates the formulas of a run again, with the options given: a ship's own coefficients, or a
/// flexural strength, which adds the parts of level ice. Level ice whose strength is not given has
/// kFlexuralStrength. A summary of an older program, which lacks inputs of the formulas, and one of
/// a 2D run stay as they are.
void evaluate_run(Summary& summary, const FormulaOptions& options);

}  // namespace ice::report
