// SPDX-License-Identifier: GPL-3.0-or-later
// The head of the report: the answer, then ship, ice and travel.
#include <fmt/format.h>

#include <cmath>

#include "common/base/time_rounding.hpp"
#include "common/base/uncertainty.hpp"
#include "common/base/units.hpp"
#include "common/formulas/formula_band.hpp"
#include "postprocess/report/formula_section.hpp"
#include "postprocess/report/page.hpp"
#include "postprocess/report/sections.hpp"
#include "postprocess/report/tables.hpp"
#include "postprocess/views/svg.hpp"

namespace ice::report {

using views::escape;
using views::readable;

namespace {

using Rows = std::vector<std::pair<std::string, std::string>>;

std::string card(const std::string& value, const std::string& name) {
    return "<div class=\"card\"><b>" + escape(value) + "</b><span>" + escape(name) +
           "</span></div>\n";
}

// a fixed number of digits for a quantity; "" where it is unknown
std::string fixed(double value, int decimals, const std::string& unit) {
    return std::isfinite(value) ? fmt::format("{:.{}f} {}", value, decimals, unit) : "";
}

void add(Rows& rows, const std::string& name, const std::string& value) {
    if (!value.empty()) rows.emplace_back(name, value);
}

std::string speed_text(double speed) {
    return std::isfinite(speed) ? fmt::format("{:.2f} m/s = {:.2f} kn", speed, speed / kKnot) : "";
}

Rows ship_rows(const Summary& s) {
    Rows rows;
    // A section of 2D has no breadth; angles are those of the waterline and may be unknown.
    add(rows, "Length, L", fixed(s.ship.length, 2, "m"));
    if (s.dimension == 3) add(rows, "Breadth, B", fixed(s.ship.breadth, 2, "m"));
    add(rows, "Draught, T", fixed(s.ship.draught, 2, "m"));
    add(rows, "Displacement", fixed(1e-3 * s.ship.displacement, 1, "t"));
    add(rows, "Stem angle", fixed(s.ship.stem_angle_deg, 1, "°"));
    add(rows, "Half entrance angle", fixed(s.ship.entrance_angle_deg, 1, "°"));
    return rows;
}

// of ice that the ship breaks
void add_bending(Rows& rows, const IceParticulars& ice) {
    if (std::isfinite(ice.flexural_strength))
        add(rows, "Flexural strength", readable(1e-3 * ice.flexural_strength) + " kPa");
    if (std::isfinite(ice.elastic_modulus))
        add(rows, "Elastic modulus", readable(1e-9 * ice.elastic_modulus) + " GPa");
    add(rows, "Bending model", ice.bending_model);
    if (std::isfinite(ice.bending_factor))
        add(rows, "Factor on the breaking load", readable(ice.bending_factor));
}

Rows ice_rows(const Summary& s) {
    const IceParticulars& ice = s.ice;
    Rows rows;
    add(rows, "Thickness", fixed(ice.thickness, 3, "m"));
    if (std::isfinite(ice.floe_size_mean)) {
        // half of the last digit shown [m]: a range with equal ends is no range
        const bool alike = ice.floe_size_max - ice.floe_size_min < 0.005;
        add(rows, s.dimension == 2 ? "Lengths of floes" : "Diameters of floes",
            alike ? fixed(ice.floe_size_mean, 2, "m")
                  : fmt::format("{:.2f} m, {:.2f} to {:.2f} m", ice.floe_size_mean,
                                ice.floe_size_min, ice.floe_size_max));
    }
    // of level ice pieces far astern are taken out, and new ones break off
    if (ice.floes > 0)
        add(rows, is_level_ice(ice) ? "Floes in the scene at the end" : "Floes",
            std::to_string(ice.floes));
    if (std::isfinite(ice.concentration))
        add(rows, "Concentration", fmt::format("{:.0f} %", 100.0 * ice.concentration));
    add(rows, "Density", fixed(ice.density, 0, "kg/m³"));
    if (std::isfinite(ice.friction_ship_ice))
        add(rows, "Friction on ship; ice",
            readable(ice.friction_ship_ice) + "; " + readable(ice.friction_ice_ice));
    if (std::isfinite(ice.density))
        // A summary without a density is of an older program and does not state the pressure
        // either; an infinite pressure is rigid ice.
        add(rows, "Crushing pressure",
            std::isfinite(ice.crushing_pressure) ? readable(1e-6 * ice.crushing_pressure) + " MPa"
                                                 : "none: rigid ice");
    if (is_level_ice(ice)) add_bending(rows, ice);
    add(rows, "Held", release_rule_in_words(s.ice));
    return rows;
}

// The published ranges are the quickest check of a case: cracks far outside them mean a wrong
// strength, modulus or thickness.
Rows crack_rows(const Summary& s) {
    Rows rows;
    if (!s.cracks) return rows;
    const CrackParticulars& c = *s.cracks;
    add(rows, "Pieces that broke off", fmt::format("{:.0f}", c.pieces));
    add(rows, "Crack to the load", fixed(c.radius, 2, "m"));
    add(rows, "In characteristic lengths",
        fmt::format("{:.2f} (ships: {})", c.per_length(), kCracksPerLength));
    add(rows, "In thicknesses",
        fmt::format("{:.1f} (ships: {})", c.per_thickness(), kCracksPerThickness));
    add(rows, "Opening angle", fixed(c.opening_deg, 0, "°"));
    add(rows, "Load of a crack", fixed(1e-3 * c.load, 0, "kN"));
    add(rows, "Channel",
        fixed(c.channel_breadth, 1, "m") + " broad" +
            (s.ship.breadth > 0.0 ? fmt::format(", {:.2f} B", c.channel_breadth / s.ship.breadth)
                                  : ""));
    return rows;
}

Rows travel_rows(const Summary& s, double speed) {
    Rows rows;
    add(rows, "Mean speed", speed_text(speed));
    add(rows, "Simulated", readable(s.simulated_s) + " s");
    add(rows, "Averaged",
        fmt::format("{} to {} s", readable(s.average_from), readable(s.simulated_s)));
    // summaries of older programs lack the travel
    if (std::isfinite(s.travel.distance))
        add(rows, "Travelled",
            fixed(s.travel.distance, 1, "m") +
                (std::isfinite(s.travel.lengths) ? fmt::format(", {:.2f} lengths", s.travel.lengths)
                                                 : ""));
    if (std::isfinite(s.travel.averaged_lengths))
        add(rows, "Averaged over", averaged_text(s.travel.averaged_lengths));
    add(rows, "Floes moved", fmt::format("{} of {}", s.floes_moved, s.floes_total));
    return rows;
}

std::string column(const std::string& heading, const Rows& rows) {
    return rows.empty() ? "" : "<h3>" + escape(heading) + "</h3>\n" + facts(rows);
}

// The interval of one run alone would suggest too much certainty: the model's uncertainty is beside
// it. In level ice that of broken ice does not apply; the error against model tests is known there.
std::string model_card(const Summary& s, const ForceUnit& unit) {
    if (is_level_ice(s.ice))
        return card(fmt::format("{:.0f} to {:.0f} %", 100.0 * kLeastLevelIceError,
                                100.0 * kLargestLevelIceError),
                    fmt::format("mean absolute error against model tests in level ice, beside "
                                "that interval; bias {:+.0f} % over the seven tests of MT Uikku "
                                "(docs/validation-measured.md)",
                                100.0 * kLevelIceBias));
    return card("± " + unit.text(kModelUncertainty * std::abs(s.resistance.mean)) + " " + unit.name,
                fmt::format("uncertainty of the model, {:.0f} %, beside that interval",
                            100.0 * kModelUncertainty));
}

}  // namespace

double mean_speed(const RunData& run, double from) {
    // Distance over time, not the mean of samples: exact for any motion between the two rows.
    const HistoryRow* first = nullptr;
    for (const HistoryRow& row : run.history)
        if (row.time >= from - kTimeRounding) {
            first = &row;
            break;
        }
    if (first == nullptr || !(run.history.back().time > first->time)) return std::nan("");
    return (run.history.back().ship_position.x() - first->ship_position.x()) /
           (run.history.back().time - first->time);
}

std::string key_numbers(const Summary& s, const ForceUnit& unit, double speed) {
    std::string out = "<div class=\"cards\">\n";
    out += card(mean_and_interval(unit, s.resistance) + " " + unit.name,
                "mean ice resistance with the 95 % interval of this run");
    for (const auto& [name, part] : parts_of(s))
        out += card(unit.text(part) + " " + unit.name, "of it " + name);
    out += model_card(s, unit);
    const auto formulas = comparable_formulas(formulas_of(s), is_level_ice(s.ice));
    if (formulas.size() == 1)
        out += card(unit.text(formulas[0].value) + " " + unit.name,
                    formulas[0].name + ", " + part_text(formulas[0]));
    if (formulas.size() > 1) {
        const FormulaBand band = *band_of(formulas);
        std::string names;
        for (const FormulaValue& f : formulas)
            names += (names.empty() ? "" : "; ") + f.name + ", " + part_text(f);
        out += card(unit.text(band.low) + " to " + unit.text(band.high) + " " + unit.name,
                    "empirical formulas: " + names + ". " + band_verdict(s));
    }
    if (is_level_ice(s.ice))
        out += card("level ice, breaks by bending", "release rule: " + release_rule(s.ice));
    else if (!s.ice.hold.empty())
        out += card(release_rule_in_words(s.ice), "release rule: until when floes are held");
    // resistance times speed; unknown where the speed is
    if (std::isfinite(speed)) {
        out += card(fmt::format("{:.2f} m/s", speed), fmt::format("{:.2f} knots", speed / kKnot));
        // kW from 10 kW on: models have watts, ships megawatts.
        const double power = s.resistance.mean * speed;
        // two ranges only: a unit that changes with every run makes cards hard to compare
        const bool large = std::abs(power) >= 1e4;
        out += card(fmt::format("{:.{}f} {}{}", large ? 1e-3 * power : power, large ? 1 : 0,
                                large ? "kW" : "W", s.dimension == 2 ? "/m" : ""),
                    "effective power: resistance times speed, without propulsive losses");
    }
    return out + "</div>\n";
}

std::string particulars_section(const Summary& s, double speed) {
    const std::vector<std::pair<std::string, Rows>> parts{
        {"Ship", ship_rows(s)},
        {"Ice", ice_rows(s)},
        {"Cracks, means of all pieces", crack_rows(s)},
        {"Run", travel_rows(s, speed)}};
    std::string body;
    for (const auto& [heading, rows] : parts)
        if (!rows.empty()) body += "<div>" + column(heading, rows) + "</div>\n";
    return section("particulars", "Ship, ice and run",
                   "L and B on the waterline, stem angle from the horizontal, floes as circles of "
                   "their areas, travel in lengths of the ship.",
                   "<div class=\"figures\">\n" + body + "</div>\n");
}

}  // namespace ice::report
