// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/report/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/formulas/formula_band.hpp"
#include "postprocess/report/page.hpp"
#include "postprocess/views/svg.hpp"

namespace ice::report {

using views::escape;
using views::readable;

namespace {

double size_of(double value) { return std::isfinite(value) ? std::abs(value) : 0.0; }

// Numbers of one column: four digits of the largest, as many decimals in all.
std::vector<std::string> column(const std::vector<double>& values) {
    double largest = 0.0;
    for (const double value : values) largest = std::max(largest, size_of(value));
    ForceUnit plain{"", 1.0, 0};
    if (largest > 0.0)
        plain.decimals = std::clamp(3 - static_cast<int>(std::floor(std::log10(largest))), 0, 6);
    std::vector<std::string> out;
    for (const double value : values) out.push_back(plain.text(value));
    return out;
}

std::string spelled(std::string key) {
    if (key.size() > 2 && key.ends_with("_J")) key.resize(key.size() - 2);
    std::replace(key.begin(), key.end(), '_', ' ');
    return key;
}

}  // namespace

std::string ForceUnit::text(double force) const {
    if (!std::isfinite(force)) return "n/a";
    const std::string number = fmt::format("{:.{}f}", force / newtons, decimals);
    // a number that rounds to zero has no sign
    return number.find_first_of("123456789") == std::string::npos && number[0] == '-'
               ? number.substr(1)
               : number;
}

ForceUnit choose_unit(double largest, int dimension) {
    const std::string per = dimension == 2 ? "/m" : "";
    const double size = size_of(largest);
    ForceUnit unit{"N" + per, 1.0, 0};
    // unit by the largest number; three digits after the first one
    if (size >= 1e4) unit = {"kN" + per, 1e3, 0};
    if (size >= 1e7) unit = {"MN" + per, 1e6, 0};
    if (size > 0.0)
        unit.decimals =
            std::clamp(3 - static_cast<int>(std::floor(std::log10(size / unit.newtons))), 0, 6);
    return unit;
}

PressureUnit choose_pressure_unit(double largest) {
    if (size_of(largest) >= 1e6) return {"MPa", 1e6};
    if (size_of(largest) >= 1e3) return {"kPa", 1e3};
    return {"Pa", 1.0};
}

namespace {

// the precision of a mean is that of its interval's two digits; without interval 4 digits of the
// mean
int decimals_for(double mean, double interval, double newtons) {
    const double size = size_of(interval) > 0.0 ? size_of(interval) : 1e-2 * size_of(mean);
    if (!(size > 0.0)) return 0;
    return std::clamp(1 - static_cast<int>(std::floor(std::log10(size / newtons))), 0, 4);
}

// NaN without samples in the second half
double recorded_resistance(const RunData& run) {
    double sum = 0.0, count = 0.0;
    for (const HistoryRow& row : run.history) {
        // Without a summary there is no stated start of the averages. The second half is past the
        // start of most runs; the number only chooses the unit.
        if (row.time < 0.5 * run.history.back().time) continue;
        sum -= row.contact_force.x() + row.friction_force.x();
        ++count;
    }
    return sum / count;
}

}  // namespace

ForceUnit page_unit(const read::RunFolder& run) {
    const double mean = run.summary ? run.summary->resistance.mean : recorded_resistance(run.data);
    const double interval = run.summary ? run.summary->resistance.ci95 : std::nan("");
    ForceUnit unit = choose_unit(mean, run.data.header.dimension);
    unit.decimals = decimals_for(mean, interval, unit.newtons);
    return unit;
}

ForceUnit moment_unit(const ForceUnit& force) {
    ForceUnit unit = force;
    const bool per_metre = unit.name.ends_with("/m");
    if (per_metre) unit.name.resize(unit.name.size() - 2);
    unit.name += per_metre ? " m/m" : " m";
    return unit;
}

std::string mean_and_interval(const ForceUnit& unit, const ForceStatistics& force) {
    return unit.text(force.mean) + " \u00b1 " + unit.text(force.ci95);
}

std::vector<FormulaValue> formulas_of(const Summary& s) {
    if (!s.formulas.empty() || !s.lindqvist_submersion) return s.formulas;
    return {{"Lindqvist (1989)", "submersion", *s.lindqvist_submersion, false}};
}

std::vector<std::pair<std::string, double>> parts_of(const Summary& s) {
    const ForceStatistics& r = s.resistance;
    if (!r.breaking_mean || !r.submersion_mean) return {};
    return {{"breaking", *r.breaking_mean}, {"submersion and all else", *r.submersion_mean}};
}

std::string force_table(const Summary& s, const ForceUnit& unit) {
    const auto row = [&](const std::string& name, const ForceStatistics& f) {
        return std::vector<std::string>{name,
                                        mean_and_interval(unit, f),
                                        unit.text(f.contact_mean),
                                        unit.text(f.friction_mean),
                                        unit.text(f.std),
                                        unit.text(f.max)};
    };
    // Parts and formulas are below the resistance that they are part of or compare with.
    std::vector<std::vector<std::string>> rows{row("Resistance (\u2212x)", s.resistance)};
    for (const auto& [name, part] : parts_of(s))
        rows.push_back({"  of it " + name, unit.text(part), "", "", "", ""});
    for (const FormulaValue& formula : comparable_formulas(formulas_of(s), is_level_ice(s.ice)))
        rows.push_back({"  " + formula.name + ", " + part_text(formula), unit.text(formula.value),
                        "", "", "", ""});
    if (s.dimension == 3) rows.push_back(row("Lateral (y, to port)", s.lateral));
    rows.push_back(row("Vertical (z, up)", s.vertical));
    return table({"Component [" + unit.name + "]", "Mean \u00b1 95 %", "Contact", "Friction",
                  "Std. deviation", "Largest in a step"},
                 rows);
}

std::string region_table(const Summary& s, const ForceUnit& unit) {
    if (s.regions.empty()) return "";
    const bool flat = s.dimension == 2;
    const std::string in = " [" + unit.name + "]";
    std::vector<std::string> header{"Region", "Hits",
                                    flat ? "Largest impulse [N s/m]" : "Largest impulse [N s]",
                                    "Mean x" + in, "Of it friction"};
    if (!flat) header.push_back("Mean y" + in);
    header.push_back("Mean z" + in);
    std::vector<double> impulse;
    for (const auto& [name, r] : s.regions) impulse.push_back(r.max_impulse);
    const std::vector<std::string> impulses = column(impulse);
    std::vector<std::vector<std::string>> rows;
    for (const auto& [name, r] : s.regions) {
        // All regions, also those without a hit: that the ice never touched a region is a result.
        // In 2D forces have no y.
        rows.push_back({name, std::to_string(r.hits), impulses[rows.size()], unit.text(r.mean[0]),
                        unit.text(r.friction_mean[0])});
        if (!flat) rows.back().push_back(unit.text(r.mean[1]));
        rows.back().push_back(unit.text(r.mean[2]));
    }
    return table(header, rows);
}

namespace {

// An entry of the energy ledger and its row in the table.
struct EnergyRow {
    const char* key;
    const char* name;
    const char* source;  // of an entry that puts energy in, its name in the sentence of the balance
};

// In the order of (19) in section 8 of docs/method.md: sources, destinations, the residual.
constexpr EnergyRow kEnergyRows[]{
    {"ship_work_J", "Work of the ship", "Work of the ship"},
    {"drift_work_J", "Put in by drifting ice that is held", "drifting ice"},
    {"separation_J", "Put in by opening overlaps", "opened overlaps"},
    {"water_work_J", "Put in by the moving water", "moving water"},
    {"applied_work_J", "Put in by applied loads", "applied loads"},
    {"potential_J", "Gained as potential energy", nullptr},
    {"kinetic_change_J", "Gained as kinetic energy", nullptr},
    {"friction_J", "Lost to friction", nullptr},
    {"restitution_J", "Lost in impacts", nullptr},
    {"crushing_J", "Lost to crushing", nullptr},
    {"breaking_J", "Lost to ice before it breaks off", nullptr},
    {"drag_J", "Lost to drag", nullptr},
    {"buoyancy_moment_J", "Taken by the moment that buoyancy \"centre\" leaves out", nullptr},
    {"residual_J", "Not explained", nullptr}};

}  // namespace

std::string energy_balance(const Summary& s) {
    std::string sources;
    for (const EnergyRow& row : kEnergyRows)
        if (row.source != nullptr && s.energy.contains(row.key))
            sources += (sources.empty() ? "" : " + ") + std::string(row.source);
    return sources + " = the sum of all entries below them.";
}

std::string energy_table(const Summary& s) {
    const auto work = s.energy.find("ship_work_J");
    if (work == s.energy.end() || !s.energy.contains("residual_J")) return "";
    std::vector<std::string> names;
    std::vector<double> values;
    for (const auto& [key, name, source] : kEnergyRows) {
        const auto found = s.energy.find(key);
        if (found == s.energy.end()) continue;
        names.emplace_back(name);
        values.push_back(found->second);
    }
    // One unit for all entries, by the largest: the reader adds them up. Its name is that of a
    // force with J in place of N.
    ForceUnit unit =
        choose_unit(*std::max_element(values.begin(), values.end(),
                                      [](double l, double r) { return size_of(l) < size_of(r); }),
                    s.dimension);
    unit.name[unit.name.find('N')] = 'J';
    std::vector<std::vector<std::string>> rows;
    for (std::size_t k = 0; k < names.size(); ++k) {
        // Shares of the ship's work, which the residual is judged by. They may exceed 100 % where
        // water or opened overlaps put energy in.
        const double percent = 100.0 * values[k] / work->second;
        const double share = std::round(100.0 * percent) / 100.0 + 0.0;  // no -0
        rows.push_back({names[k], unit.text(values[k]),
                        std::isfinite(share) ? fmt::format("{:.2f}", share) : "n/a"});
    }
    return table({"Energy [" + unit.name + "]", "Whole run", "Share [%]"}, rows);
}

namespace {

// What a share of the mean means for the answer, by the bound of the warnings.
std::string effect(double share) {
    return fmt::format("the mean is {}affected (it counts as affected from {:g} % on)",
                       std::abs(share) > kMatters ? "" : "hardly ", 100.0 * kMatters);
}

// The count alone does not bound the error: most steps may miss the tolerance by very little.
std::string unconverged_text(const Summary& s) {
    std::string out = fmt::format("{} of {}", s.unconverged_steps, s.steps);
    // summaries of older programs lack the share
    if (s.unconverged_steps > 0 && std::isfinite(s.residual_share))
        out += fmt::format("; the impulses that they lack are {:.2g} % of all: {}",
                           100.0 * s.residual_share, effect(s.residual_share));
    return out;
}

std::string overlap_text(const Summary& s) {
    std::string out = readable(1000.0 * s.max_overlap) + " mm";
    const auto work = s.energy.find("ship_work_J"), put_in = s.energy.find("separation_J");
    if (work != s.energy.end() && put_in != s.energy.end() && work->second != 0.0) {
        const double share = put_in->second / work->second + 0.0;
        out += fmt::format("; opening all overlaps added {:.2g} % of the ship's work: {}",
                           100.0 * share, effect(share));
    }
    return out;
}

}  // namespace

std::string numerics_table(const Summary& s) {
    std::vector<std::pair<std::string, std::string>> rows{
        {"Contacts with an impulse", "mean " + readable(s.contacts_mean) + ", largest " +
                                         readable(s.contacts_max) + " per step"},
        {"Deepest overlap", overlap_text(s)},
        {"Steps that did not converge", unconverged_text(s)},
        {"Spheres", fmt::format("{} hull, {} ice", s.hull_spheres, s.ice_spheres)}};
    for (const auto& [key, value] : s.stage_seconds)
        rows.emplace_back("Computing time: " + spelled(key), fmt::format("{:.2f} s", value));
    return facts(rows);
}

std::string warning_list(const std::vector<Warning>& warnings) {
    if (warnings.empty()) return "";
    std::string out =
        "<section id=\"warnings\" class=\"warnings\">\n<b>Warnings of the run</b>\n<ul>\n";
    for (const Warning& w : warnings) out += "<li>" + escape(with_verdict(w)) + "</li>\n";
    return out + "</ul>\n</section>\n";
}

}  // namespace ice::report
