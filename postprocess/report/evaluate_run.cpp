// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/report/evaluate_run.hpp"

#include <cmath>

namespace ice::report {

void evaluate_run(Summary& s, const FormulaOptions& options) {
    FormulaOptions chosen = options;
    const bool stated =
        std::isfinite(options.flexural_strength) || std::isfinite(s.ice.flexural_strength);
    // level ice without a stated strength gets the usual one: formulas for it need a number
    if (is_level_ice(s.ice) && !stated) chosen.flexural_strength = kFlexuralStrength;
    // A summary of an older program states too little of ship or ice: it keeps the values that it
    // has.
    auto formulas = evaluate_formulas(s.ship, s.ice, s.ship.speed_mean, chosen);
    if (formulas.empty() || !std::isfinite(s.ice.water_density)) return;
    s.formula_strength = chosen.flexural_strength;
    s.formulas = std::move(formulas);
}

}  // namespace ice::report
