// SPDX-License-Identifier: GPL-3.0-or-later
/// Empirical formulas beside a run.
#pragma once

#include <string>
#include <vector>

#include "postprocess/report/tables.hpp"

namespace ice::report {

/// The run's resistance and the formulas as bars that show their components, the band that the
/// comparable ones span, a table of all parts, and which of them are recalled. "" without formulas.
std::string formula_section(const Summary& summary, const ForceUnit& unit);

/// "The run lies 42 % below this band." of the comparable formulas, or within it; "" for fewer than
/// two of them.
std::string band_verdict(const Summary& summary);

/// The bars as a drawing of this width [px]: only values comparable with the run. "" without any,
/// or where nothing is above 0.
std::string draw_formulas(const Summary& summary, const ForceUnit& unit, double width);

/// "Recalled, compared with no published number: ..."; "" where all are verified.
std::string formula_footnote(const std::vector<FormulaValue>& formulas);

}  // namespace ice::report
