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

// A formula's dashes are the same for all its parts in a chart.
std::string dash_of(const Curve& curve, const std::string& name) {
    for (const FormulaCurve& f : comparable_curves({curve}))
        if (f.name == name) return f.dash;
    return kDashes[0];
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
    for (const FormulaValue& f : curve.points.front().formulas) {
        // Buoyancy is a part of every formula for broken ice.
        if (!level && f.part == "buoyancy")
            out.push_back({f.name, f.part, author_of(f.name) + ", " + f.part, "1 2"});
        // Lindqvist's crushing at the stem and bending are together what others call breaking.
        if (level && (f.part == "breaking" || f.part == "crushing"))
            out.push_back(
                {f.name, f.part,
                 author_of(f.name) + (f.part == "breaking" ? ", breaking" : ", crushing + bending"),
                 dash_of(curve, f.name), f.part == "breaking" ? "" : "bending"});
    }
    return out;
}

std::vector<FormulaCurve> broken_curves(const Curve& curve) {
    ICE_ASSERT(!curve.points.empty());
    std::vector<FormulaCurve> out;
    if (!curve.points.front().level_ice) return out;
    for (const FormulaValue& f : comparable_formulas(curve.points.front().formulas, false))
        out.push_back({f.name, f.part, author_of(f.name) + ", " + f.part, dash_of(curve, f.name)});
    return out;
}

double value_at(const Point& point, const FormulaCurve& drawn) {
    const double value = point.formula(drawn.name, drawn.part);
    return drawn.plus.empty() ? value : value + point.formula(drawn.name, drawn.plus);
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
