// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/sweep/formula_curves.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/assert.hpp"

namespace ice::sweep {

namespace {

// Dash patterns of the formulas in their order: prints in grey keep them apart. A fifth formula has
// the first pattern again.
constexpr const char* kDashes[] = {"2 3", "7 3 2 3", "9 4", "4 2"};

template <class List>
bool lists(const List& list, const FormulaValue& f) {
    return std::any_of(list.begin(), list.end(), [&](const auto& known) {
        return known.name == f.name && known.part == f.part;
    });
}

}  // namespace

std::string author_of(const std::string& name) {
    // "Lindqvist 1989" is Lindqvist on a chart; the legend of a table has the year.
    const auto space = name.rfind(' ');
    const bool year =
        space != std::string::npos && name.size() == space + 5 &&
        std::all_of(name.end() - 4, name.end(), [](char c) { return c >= '0' && c <= '9'; });
    return year ? name.substr(0, space) : name;
}

std::vector<FormulaCurve> comparable_curves(const std::vector<Curve>& curves) {
    std::vector<FormulaCurve> out;
    for (const Curve& curve : curves)
        for (const Point& point : curve.points)
            for (const FormulaValue& f : comparable_formulas(point.formulas, point.level_ice))
                // A formula has one curve, in the order in which formulas appear, although points
                // may lack it.
                if (std::isfinite(f.value) && !lists(out, f))
                    out.push_back({f.name, f.part, author_of(f.name),
                                   kDashes[out.size() % std::size(kDashes)]});
    return out;
}

std::vector<FormulaCurve> component_curves(const Curve& curve) {
    ICE_ASSERT(!curve.points.empty());
    std::vector<FormulaCurve> out;
    const bool level = curve.points.front().level_ice;
    for (const FormulaValue& f : curve.points.front().formulas)
        // Buoyancy is a part of every formula for broken ice. In level ice the total has curves of
        // its own, and these show the resistance if the ice were broken already.
        if (f.part == "buoyancy" ||
            (level && (f.part == "submersion" || f.part == "buoyancy + clearing")))
            out.push_back({f.name, f.part, author_of(f.name) + ", " + f.part, "1 2"});
    return out;
}

std::optional<FormulaBand> formula_band(const Point& point) {
    return band_of(comparable_formulas(point.formulas, point.level_ice));
}

std::vector<FormulaValue> formula_columns(const std::vector<Point>& points) {
    std::vector<FormulaValue> out;
    for (const Point& point : points)
        for (const FormulaValue& f : point.formulas)
            if (!lists(out, f)) out.push_back(f);
    return out;
}

}  // namespace ice::sweep
