// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/report/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "postprocess/report/page.hpp"
#include "postprocess/views/svg.hpp"

namespace ice::report {

using views::escape;
using views::readable;

namespace {

double size_of(double value) { return std::isfinite(value) ? std::abs(value) : 0.0; }

double largest_of(const ForceStatistics& f) {
    return std::max(
        {size_of(f.mean), size_of(f.contact_mean), size_of(f.friction_mean), size_of(f.std)});
}

std::string with_interval(const ForceUnit& unit, const ForceStatistics& force) {
    // two digits of the interval say all that the mean is worth
    ForceUnit fine = unit;
    const double interval = size_of(force.ci95) / unit.newtons;
    if (interval > 0.0)
        fine.decimals = std::clamp(1 - static_cast<int>(std::floor(std::log10(interval))), 0, 4);
    return fine.text(force.mean) + " \u00b1 " + fine.text(force.ci95);
}

std::string card(const std::string& value, const std::string& name) {
    return "<div class=\"card\"><b>" + escape(value) + "</b><span>" + escape(name) +
           "</span></div>\n";
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
    // what rounds to zero has no sign
    return number.find_first_of("123456789") == std::string::npos && number[0] == '-'
               ? number.substr(1)
               : number;
}

ForceUnit choose_unit(double largest, int dimension) {
    const std::string per = dimension == 2 ? "/m" : "";
    const double size = size_of(largest);
    ForceUnit unit{"N" + per, 1.0, 0};
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

std::string key_numbers(const Summary& s) {
    const ForceUnit unit = choose_unit(s.resistance.mean, s.dimension);
    std::string out = "<div class=\"cards\">\n";
    out += card(with_interval(unit, s.resistance) + " " + unit.name, "mean ice resistance, 95 %");
    if (s.lindqvist_submersion)
        out += card(unit.text(*s.lindqvist_submersion) + " " + unit.name,
                    "Lindqvist (1989), submersion part");
    out += card(fmt::format("{} / {}", s.floes_moved, s.floes_total), "floes moved / in all");
    out += card(readable(s.simulated_s) + " s", "simulated");
    out += card(readable(s.simulated_s / s.wall_s) + " \u00d7", "real time");
    return out + "</div>\n";
}

std::string force_table(const Summary& s) {
    const ForceUnit unit = choose_unit(
        std::max({largest_of(s.resistance), largest_of(s.lateral), largest_of(s.vertical)}),
        s.dimension);
    const auto row = [&](const std::string& name, const ForceStatistics& f) {
        return std::vector<std::string>{name,
                                        with_interval(unit, f),
                                        unit.text(f.contact_mean),
                                        unit.text(f.friction_mean),
                                        unit.text(f.std),
                                        unit.text(f.max)};
    };
    std::vector<std::vector<std::string>> rows{row("Resistance (\u2212x)", s.resistance)};
    if (s.lindqvist_submersion)
        rows.push_back({"  Lindqvist (1989), submersion part only",
                        unit.text(*s.lindqvist_submersion), "", "", "", ""});
    if (s.dimension == 3) rows.push_back(row("Lateral (y, to port)", s.lateral));
    rows.push_back(row("Vertical (z, up)", s.vertical));
    return table({"Component [" + unit.name + "]", "Mean \u00b1 95 %", "Contact", "Friction",
                  "Std. deviation", "Largest"},
                 rows);
}

std::string region_table(const Summary& s) {
    if (s.regions.empty()) return "";
    double largest = 0.0;
    for (const auto& [name, region] : s.regions)
        for (const double v : region.mean) largest = std::max(largest, size_of(v));
    const ForceUnit unit = choose_unit(largest, s.dimension);
    const std::string impulse =
        s.dimension == 2 ? "Largest impulse [N s/m]" : "Largest impulse [N s]";
    std::vector<std::vector<std::string>> rows;
    for (const auto& [name, r] : s.regions) {
        if (name == "hull" && r.hits == 0)
            continue;  // parts without a name, of which there are none
        rows.push_back({name, std::to_string(r.hits), readable(r.max_impulse), unit.text(r.mean[0]),
                        unit.text(r.friction_mean[0]), unit.text(r.mean[1]), unit.text(r.mean[2])});
    }
    return table({"Region", "Hits", impulse, "Mean x [" + unit.name + "]", "Of it friction",
                  "Mean y [" + unit.name + "]", "Mean z [" + unit.name + "]"},
                 rows);
}

std::string energy_table(const Summary& s) {
    // in the order of the balance: what went in, where it went, what is unaccounted for
    static const std::vector<std::pair<const char*, const char*>> kRows{
        {"ship_work_J", "Work of the ship"},
        {"separation_J", "Put in by opening overlaps"},
        {"potential_J", "Gained as potential energy"},
        {"kinetic_change_J", "Gained as kinetic energy"},
        {"friction_J", "Lost to friction"},
        {"restitution_J", "Lost in impacts"},
        {"crushing_J", "Lost to crushing"},
        {"drag_J", "Lost to drag"},
        {"buoyancy_moment_J", "Taken by the moment that buoyancy \"centre\" leaves out"},
        {"residual_J", "Not explained"}};
    const auto work = s.energy.find("ship_work_J");
    if (work == s.energy.end() || !s.energy.contains("residual_J")) return "";
    std::vector<std::vector<std::string>> rows;
    for (const auto& [key, name] : kRows) {
        const auto found = s.energy.find(key);
        if (found == s.energy.end()) continue;
        const double percent = 100.0 * found->second / work->second;
        const double share = std::round(100.0 * percent) / 100.0 + 0.0;  // no -0
        rows.push_back({name, readable(found->second),
                        std::isfinite(share) ? fmt::format("{:.2f}", share) : "n/a"});
    }
    return table(
        {s.dimension == 2 ? "Energy [J/m]" : "Energy [J]", "Whole run", "% of the ship's work"},
        rows);
}

std::string numerics_table(const Summary& s) {
    std::vector<std::pair<std::string, std::string>> rows{
        {"Contacts with an impulse", "mean " + readable(s.contacts_mean) + ", largest " +
                                         readable(s.contacts_max) + " per step"},
        {"Deepest overlap", readable(1000.0 * s.max_overlap) + " mm"},
        {"Steps that did not converge", fmt::format("{} of {}", s.unconverged_steps, s.steps)},
        {"Spheres", fmt::format("{} hull, {} ice", s.hull_spheres, s.ice_spheres)}};
    for (const auto& [key, value] : s.stage_seconds)
        rows.emplace_back("Computing time: " + spelled(key), readable(value) + " s");
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
