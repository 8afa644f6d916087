// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/record/result_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "common/base/assert.hpp"
#include "common/base/units.hpp"
#include "common/formulas/formula_band.hpp"

namespace ice {

namespace {

// From here on values are printed in kN and kJ [N, J]. A larger bound prints longer numbers, a
// smaller one more digits after the point.
constexpr double kKilo = 1e4;
// Share of the ship's work [-] from which an entry of the energy ledger is printed. A larger value
// leaves entries unsaid, a smaller one hides the large ones among small ones.
constexpr double kShown = 0.01;

// Numbers in one unit and to one digit: a value, its interval and its parts then compare at a
// glance. More digits would suggest a precision that the mean does not have.
struct Format {
    double unit = 1.0;
    std::string name;
    double step = 1.0;  // of the last digit, in that unit
    int decimals = 0;

    std::string operator()(double value) const {
        return fmt::format("{:.{}f}", std::round(value / unit / step) * step + 0.0, decimals);
    }
};

// @param error  the value is shown to two digits of it
Format format_for(double value, double error, int dimension, const char* unit) {
    Format out;
    const bool kilo = std::abs(value) >= kKilo;
    out.unit = kilo ? 1e3 : 1.0;
    out.name = fmt::format("{}{}{}", kilo ? "k" : "", unit, dimension == 2 ? "/m" : "");
    if (!(error > 0.0) || !std::isfinite(error)) error = 0.01 * std::abs(value);
    // two digits of the error, and no more digits of the value than that
    if (!(error > 0.0)) return out;
    const int digit = static_cast<int>(std::floor(std::log10(error / out.unit))) - 1;
    out.step = std::pow(10.0, digit);
    out.decimals = std::clamp(-digit, 0, 9);
    return out;
}

}  // namespace

std::string force_text(double value, double half_width, int dimension) {
    const Format format = format_for(value, half_width, dimension, "N");
    if (!std::isfinite(half_width))
        return fmt::format("{} {} (too short for an interval)", format(value), format.name);
    return fmt::format("{} +- {} {}", format(value), format(half_width), format.name);
}

std::string force_text(double value) {
    const Format format = format_for(value, 0.0, 3, "N");
    return fmt::format("{} {}", format(value), format.name);
}

std::string resistance_line(const Summary& s) {
    // two states have no mean: averages that never began, and a ship that nothing touched
    const double speed = s.ship.speed_mean;
    const ForceStatistics& r = s.resistance;
    const auto moved = fmt::format("{} of {} floes moved", s.floes_moved, s.floes_total);
    if (!std::isfinite(r.mean))
        return "resistance unknown: the run ended before output.average_from; " + moved;
    if (s.contacts_max == 0.0 && r.mean == 0.0)
        return fmt::format("no contact: nothing touched the ship at {:.3g} m/s ({:.3g} kn); {}",
                           speed, speed / kKnot, moved);
    const Format format = format_for(r.mean, r.ci95, s.dimension, "N");
    const std::string parts =
        r.breaking_mean && r.submersion_mean
            ? fmt::format("; of it breaking {}, submersion and all else {}",
                          format(*r.breaking_mean), format(*r.submersion_mean))
            : "";
    return fmt::format("resistance {}{} at {:.3g} m/s ({:.3g} kn): contact {}, friction {}{}; {}",
                       force_text(r.mean, r.ci95, s.dimension),
                       std::isfinite(r.ci95) ? " (95 %)" : "", speed, speed / kKnot,
                       format(r.contact_mean), format(r.friction_mean), parts, moved);
}

std::string formulas_line(const Summary& s) {
    // the submersion is a part only of the resistance of a ship that breaks the ice
    if (!is_level_ice(s.ice))
        return s.lindqvist_submersion
                   ? "Lindqvist's submersion resistance: " + force_text(*s.lindqvist_submersion)
                   : "";
    const std::vector<FormulaValue> totals = comparable_formulas(s.formulas, true);
    const auto band = band_of(totals);
    if (!band) return "";
    std::vector<std::string> names;
    for (const FormulaValue& f : totals) names.push_back(f.name);
    const Format format = format_for(band->high, 0.0, s.dimension, "N");
    const std::string low = format(band->low), high = format(band->high);
    std::vector<std::string> recalled;
    for (const auto& [name, parts] : recalled_formulas(totals)) recalled.push_back(name);
    return fmt::format(
        "formulas for level ice, total: {}{} {} ({}){}", low == high ? "" : low + " to ", high,
        format.name, fmt::join(names, ", "),
        recalled.empty() ? "" : fmt::format("; {}: {}", kRecalled, fmt::join(recalled, ", ")));
}

std::string energy_line(const Summary& s) {
    // shares of the ship's work; entries that a case does not have are missing
    const auto found = s.energy.find("ship_work_J");
    if (found == s.energy.end() || found->second == 0.0) return "";
    const double work = found->second;
    std::vector<std::pair<double, const char*>> shares;
    for (const auto& [key, name] :
         {std::pair("potential_J", "raised or sunk"), std::pair("kinetic_change_J", "moving"),
          std::pair("friction_J", "friction"), std::pair("restitution_J", "impacts"),
          std::pair("crushing_J", "crushing"), std::pair("breaking_J", "breaking"),
          std::pair("drag_J", "drag"), std::pair("buoyancy_moment_J", "left-out buoyancy moment"),
          std::pair("separation_J", "put in by opened overlaps"),
          std::pair("water_work_J", "put in by the water"),
          std::pair("applied_work_J", "put in by applied loads"),
          std::pair("residual_J", "unexplained")}) {
        const auto of_key = s.energy.find(key);
        if (of_key == s.energy.end()) continue;
        // the largest shares first; small ones would hide them
        if (const double share = of_key->second / work; std::abs(share) >= kShown)
            shares.emplace_back(share, name);
    }
    std::stable_sort(shares.begin(), shares.end(), [](const auto& l, const auto& r) {
        return std::abs(l.first) > std::abs(r.first);
    });
    const Format format = format_for(work, 0.0, s.dimension, "J");
    std::string line = fmt::format("work of the ship {} {}", format(work), format.name);
    for (std::size_t k = 0; k < shares.size(); ++k)
        line += fmt::format("{} {} {:.0f} %", k == 0 ? ":" : ",", shares[k].second,
                            100.0 * shares[k].first);
    return line;
}

std::string ensemble_line(const Summary& s) {
    ICE_ASSERT(s.ensemble.has_value());
    const Ensemble& e = *s.ensemble;
    const Format format = format_for(e.mean, e.ci95, s.dimension, "N");
    std::vector<std::string> means;
    for (const double mean : e.means) means.push_back(format(mean));
    const std::string mean =
        std::isfinite(e.ci95)
            ? force_text(e.mean, e.ci95, s.dimension) + " (95 %, Student)"
            : fmt::format("{} {} (one member: no interval)", format(e.mean), format.name);
    return fmt::format("ensemble of {}: resistance {}; members {} {}", e.means.size(), mean,
                       fmt::join(means, ", "), format.name);
}

}  // namespace ice
