// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/formulas/formula_band.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/units.hpp"
#include "common/formulas/lindqvist.hpp"
#include "common/formulas/riska.hpp"

namespace ice {

namespace {

constexpr const char* kRiska = "Riska 1997";
constexpr const char* kBroken = "buoyancy + clearing";

// The value of the options if it is finite, else that of the run. NaN marks an unknown value.
double known_or(double value, double otherwise) { return std::isfinite(value) ? value : otherwise; }

}  // namespace

// The ship breaks ice that is held until it bends. In all other cases the ice is broken from the
// start, and the breaking part of a formula does not apply.
bool is_level_ice(const IceParticulars& ice) {
    return std::find(ice.hold.begin(), ice.hold.end(), "until-bent") != ice.hold.end();
}

std::vector<FormulaValue> evaluate_formulas(const ShipParticulars& ship, const IceParticulars& ice,
                                            double speed, const FormulaOptions& options) {
    const HullDimensions hull{ship.length,
                              ship.breadth,
                              ship.draught,
                              ship.stem_angle_deg * kDegree,
                              ship.entrance_angle_deg * kDegree,
                              ship.parallel_length,
                              ship.bow_length};
    const double strength = known_or(options.flexural_strength, ice.flexural_strength);
    // Formulas have no direction: a ship that backs has the resistance of its speed ahead.
    const IceConditions conditions{ice.thickness,
                                   ice.friction_ship_ice,
                                   ice.density,
                                   ice.water_density,
                                   ice.gravity,
                                   std::abs(speed),
                                   strength,
                                   known_or(ice.elastic_modulus, kElasticModulus),
                                   known_or(ice.poisson_ratio, kPoissonRatio)};
    std::vector<FormulaValue> out;
    const auto add = [&](const std::string& name, const char* part, double value, bool verified) {
        // A formula without one of its inputs gives NaN and no row: most runs have no strength.
        if (std::isfinite(value)) out.push_back({name, part, value, verified});
    };
    const LindqvistParts lindqvist = lindqvist_resistance(hull, conditions);
    add(kLindqvist, "submersion", lindqvist.submersion, false);
    add(kLindqvist, "crushing", lindqvist.crushing, false);
    add(kLindqvist, "bending", lindqvist.bending, false);
    add(kLindqvist, kTotal, lindqvist.total(), false);
    // Riska's total contains no strength, but it is a formula for level ice: without a strength the
    // run had none.
    if (std::isfinite(strength)) add(kRiska, kTotal, riska_resistance(hull, conditions), false);
    const SpencerCoefficients& own = options.spencer;
    const SpencerParts spencer = spencer_resistance(hull, conditions, own);
    add(own.name, "buoyancy", spencer.buoyancy, own.own);
    add(own.name, "clearing", spencer.clearing, own.own);
    add(own.name, kBroken, spencer.broken_ice(), own.own);
    // published values check Jeong's breaking and total, not its other parts (method, section 11)
    add(own.name, "breaking", spencer.breaking, true);
    add(own.name, kTotal, spencer.total(), true);
    return out;
}

std::vector<FormulaValue> comparable_formulas(const std::vector<FormulaValue>& formulas,
                                              bool level_ice) {
    std::vector<FormulaValue> out;
    for (const FormulaValue& f : formulas)
        // Of ice that is broken already, only the parts without breaking can be compared:
        // Lindqvist's submersion and Jeong's buoyancy and clearing.
        if (level_ice ? f.part == kTotal : f.part == "submersion" || f.part == kBroken)
            out.push_back(f);
    return out;
}

std::optional<FormulaBand> band_of(const std::vector<FormulaValue>& formulas) {
    if (formulas.empty()) return std::nullopt;
    FormulaBand band{formulas.front().value, formulas.front().value};
    for (const FormulaValue& f : formulas) {
        band.low = std::min(band.low, f.value);
        band.high = std::max(band.high, f.value);
    }
    return band;
}

std::vector<std::pair<std::string, std::string>> recalled_formulas(
    const std::vector<FormulaValue>& formulas) {
    std::vector<std::pair<std::string, std::string>> out;
    for (const FormulaValue& f : formulas) {
        if (f.verified) continue;
        const auto known = std::find_if(out.begin(), out.end(),
                                        [&](const auto& entry) { return entry.first == f.name; });
        if (known == out.end())
            out.emplace_back(f.name, f.part);
        else
            known->second += ", " + f.part;
    }
    return out;
}

std::string part_text(const FormulaValue& f) {
    if (f.part == kTotal) return "level ice, total";
    return f.part + (f.part == kBroken ? "" : " part");
}

}  // namespace ice
