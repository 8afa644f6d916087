// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/report/formula_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "common/formulas/formula_band.hpp"
#include "postprocess/report/page.hpp"
#include "postprocess/views/chart.hpp"
#include "postprocess/views/svg.hpp"

namespace ice::report {

namespace {

// Room for the names, for the number behind the longest bar, and for title and legend; distance of
// bars and their height [px]. A name longer than kLeft is cut at the picture's edge.
constexpr double kLeft = 150.0, kRight = 110.0, kTop = 46.0, kRow = 34.0, kBar = 18.0;
// Baseline of the legend's first row, and distance of its rows [px].
constexpr double kLegend = 36.0, kLegendRow = 18.0;

// Of this run, beside its breaking.
constexpr const char* kElse = "submersion and all else";

// A bar: its parts from the left, each a name and a force [N], in 2D [N/m].
struct Bar {
    std::string name;
    std::vector<std::pair<std::string, double>> parts;
    double half = 0.0;  // half width of its interval, 95 % [N]

    double length() const {
        double sum = 0.0;
        for (const auto& [part, force] : parts) sum += force;
        return sum;
    }
};

const char* color_of(const std::string& part) {
    static const std::map<std::string, const char*> kColors{
        {"this run", views::kBlack},  {kElse, views::kBlack},      {"submersion", views::kBlue},
        {"buoyancy", views::kBlue},   {"clearing", views::kGreen}, {"bending", views::kOrange},
        {"breaking", views::kOrange}, {"crushing", views::kPurple}};
    const auto found = kColors.find(part);
    return found == kColors.end() ? "#8a949c" : found->second;
}

// Bars of the run and of the formulas that compare with it, by parts; one sum where parts are
// unknown.
std::vector<Bar> make_bars(const Summary& s) {
    Bar run{"this run", {{"this run", s.resistance.mean}}, s.resistance.ci95};
    if (s.resistance.breaking_mean && s.resistance.submersion_mean)
        run.parts = {{kElse, *s.resistance.submersion_mean},
                     {"breaking", *s.resistance.breaking_mean}};
    std::vector<Bar> bars{run};
    const auto formulas = formulas_of(s);
    const bool level = is_level_ice(s.ice);
    for (const FormulaValue& sum : comparable_formulas(formulas, level)) {
        Bar bar{sum.name, {}};
        // the force of breaking compares with runs in level ice only
        for (const FormulaValue& f : formulas) {
            const bool breaks = f.part == "crushing" || f.part == "bending" || f.part == "breaking";
            const bool part = f.part == "submersion" || f.part == "buoyancy" ||
                              f.part == "clearing" || (breaks && level);
            if (f.name == sum.name && part) bar.parts.emplace_back(f.part, f.value);
        }
        if (bar.parts.empty()) bar.parts.emplace_back(sum.part, sum.value);
        bars.push_back(bar);
    }
    return bars;
}

std::string rectangle(double x, double y, double width, double height, const std::string& more) {
    return fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" {}/>\n",
                       views::pixels(x), views::pixels(y), views::pixels(width),
                       views::pixels(height), more);
}

std::string draw_bar(const Bar& bar, double y, double per_newton, const ForceUnit& unit) {
    std::string out = views::text_element(kLeft - 8.0, y + 14.0, bar.name, "end");
    double x = kLeft;
    for (const auto& [part, force] : bar.parts) {
        // a part below 0 has no bar; its number is in the sum
        const double width = std::max(0.0, force * per_newton);
        out += rectangle(x, y, width, kBar,
                         fmt::format("fill=\"{}\" opacity=\"0.85\"", color_of(part)));
        x += width;
    }
    if (bar.half > 0.0) {
        const double middle = y + 0.5 * kBar, half = bar.half * per_newton;
        out += views::line_element(x - half, middle, x + half, middle,
                                   "stroke=\"#888888\" stroke-width=\"3\"");
        x += half;
    }
    return out + views::text_element(x + 8.0, y + 14.0, unit.text(bar.length()), "start");
}

// Each part once, in the order in which the bars have them. The run's own bar is named at its left.
std::vector<std::string> legend_names(const std::vector<Bar>& bars) {
    std::vector<std::string> out;
    for (const Bar& bar : bars)
        for (const auto& [part, force] : bar.parts)
            if (part != "this run" && std::find(out.begin(), out.end(), part) == out.end())
                out.push_back(part);
    return out;
}

// In rows that fit into `width` [px]; `rows` becomes their number.
std::string draw_legend(const std::vector<Bar>& bars, double width, int& rows) {
    std::string out;
    double x = kLeft;
    rows = 1;
    for (const std::string& part : legend_names(bars)) {
        const double room = 17.0 + views::text_width(part) + 14.0;
        if (x > kLeft && x + room > width) {
            x = kLeft;
            ++rows;
        }
        const double y = kLegend + kLegendRow * (rows - 1);
        out += rectangle(x, y - 10.0, 12.0, 12.0,
                         fmt::format("fill=\"{}\" opacity=\"0.85\"", color_of(part)));
        out += views::text_element(x + 17.0, y, part, "start");
        x += room;
    }
    return out;
}

}  // namespace

std::string draw_formulas(const Summary& s, const ForceUnit& unit, double width) {
    const std::vector<Bar> bars = make_bars(s);
    double longest = 0.0;
    for (const Bar& bar : bars) longest = std::max(longest, bar.length() + bar.half);
    if (bars.size() < 2 || !(longest > 0.0)) return "";
    const double per_newton = (width - kLeft - kRight) / longest;
    int rows = 0;
    const std::string legend = draw_legend(bars, width, rows);
    const double top = kTop + kLegendRow * (rows - 1);
    const double height = top + kRow * static_cast<double>(bars.size()) + 6.0;
    const std::string title = "Resistance and formulas [" + unit.name + "]";
    std::string out = views::svg_open(width, height, title) +
                      views::text_element(8.0, 16.0, title, "start", "font-weight=\"600\"");
    const auto band = band_of(comparable_formulas(formulas_of(s), is_level_ice(s.ice)));
    // the band of the comparable formulas, behind the bars
    if (band && band->high > band->low)
        out += rectangle(kLeft + band->low * per_newton, top - 4.0,
                         (band->high - band->low) * per_newton, height - top,
                         "fill=\"#b8c4cc\" opacity=\"0.45\"");
    for (std::size_t k = 0; k < bars.size(); ++k)
        out += draw_bar(bars[k], top + kRow * static_cast<double>(k) + 4.0, per_newton, unit);
    return out + legend + "</svg>\n";
}

std::string band_verdict(const Summary& s) {
    const auto compared = comparable_formulas(formulas_of(s), is_level_ice(s.ice));
    const double mean = s.resistance.mean;
    const auto band = band_of(compared);
    if (compared.size() < 2 || !band || !(band->low > 0.0) || !std::isfinite(mean)) return "";
    const bool below = mean < band->low;
    if (!below && mean <= band->high) return "The run lies within this band.";
    const double percent = 100.0 * std::abs(mean / (below ? band->low : band->high) - 1.0);
    return fmt::format("The run lies {:.{}f} % {} this band.", percent, percent < 9.95 ? 1 : 0,
                       below ? "below" : "above");
}

std::string formula_footnote(const std::vector<FormulaValue>& formulas) {
    std::string list;
    for (const auto& [name, parts] : recalled_formulas(formulas))
        list += fmt::format("{} {} ({})", list.empty() ? "" : ";", name, parts);
    return list.empty() ? "" : fmt::format("R{}:{}.", kRecalled + 1, list);
}

std::string formula_section(const Summary& s, const ForceUnit& unit) {
    const auto formulas = formulas_of(s);
    if (formulas.empty()) return "";
    const bool level = is_level_ice(s.ice);
    const auto compared = comparable_formulas(formulas, level);
    std::vector<std::vector<std::string>> rows;
    // a formula's part that agrees with the run is marked
    for (const FormulaValue& f : formulas) {
        const bool same = std::any_of(compared.begin(), compared.end(), [&](const auto& c) {
            return c.name == f.name && c.part == f.part;
        });
        rows.push_back({f.name + ", " + f.part, unit.text(f.value), same ? "yes" : "-",
                        f.verified ? "yes" : "recalled"});
    }
    std::string intro =
        level ? "This run breaks level ice: it is compared with the totals of the formulas."
              : "This run's ice is broken from the start: it is compared with the formulas' parts "
                "for broken ice. Their breaking part, for level ice, comes on top.";
    if (const std::string verdict = band_verdict(s); !verdict.empty()) {
        const FormulaBand band = *band_of(compared);
        intro += fmt::format(" They span {} to {} {}. {}", unit.text(band.low),
                             unit.text(band.high), unit.name, verdict);
    }
    const double strength =
        std::isfinite(s.formula_strength) ? s.formula_strength : s.ice.flexural_strength;
    if (std::isfinite(strength))
        intro += fmt::format(" Level ice of {} kPa.", views::readable(1e-3 * strength));
    intro += " " + formula_footnote(formulas) +
             " For which ships, ice and speeds their sources hold, we have not read.";
    return section(
        "formulas", "Empirical formulas", intro,
        figures({draw_formulas(s, unit, 440.0)}) +
            table({"Formula, part", "Value [" + unit.name + "]", "Comparable", "Verified"}, rows));
}

}  // namespace ice::report
