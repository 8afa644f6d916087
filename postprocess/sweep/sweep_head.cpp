// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/sweep/sweep_head.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "common/formulas/formula_band.hpp"
#include "postprocess/report/page.hpp"
#include "postprocess/views/svg.hpp"

namespace ice::sweep {

using views::readable;

namespace {

// Values of one number of the summaries.
class Range {
public:
    void add(double value) {
        if (std::isfinite(value)) values_.insert(value);
    }
    bool known() const { return !values_.empty(); }
    // "0.5", or "0.3 to 0.8"; the numbers are `factor` times the values
    std::string text(double factor = 1.0) const {
        return from_to(readable(factor * *values_.begin()), readable(factor * *values_.rbegin()));
    }
    std::string knots() const {
        return from_to(fmt::format("{:.2f}", *values_.begin() / kKnot),
                       fmt::format("{:.2f}", *values_.rbegin() / kKnot));
    }

private:
    static std::string from_to(const std::string& low, const std::string& high) {
        return low == high ? low : low + " to " + high;
    }
    // a set: in order, and equal runs count once
    std::set<double> values_;
};

class Facts {
public:
    explicit Facts(const Sweep& sweep) {
        for (const SweepRun& run : sweep.runs) {
            // runs without a summary have no numbers of ship and ice
            if (!run.summary) continue;
            ++(is_level_ice(run.summary->ice) ? level_ : broken_);
            if (!run.summary->ice.bending_model.empty())
                models_.insert(run.summary->ice.bending_model);
            const auto speed = run.settings.find(kSpeedKey);
            if (speed != run.settings.end() && speed->second.number)
                speeds_.add(*speed->second.number);
            // by the summaries' own keys: a range where runs differ
            for (const auto& [key, value] : read_json_numbers(run.folder / "summary.json"))
                if (key.starts_with("ship.") || key.starts_with("ice.")) numbers_[key].add(value);
        }
    }

    std::vector<std::pair<std::string, std::string>> rows() {
        std::vector<std::pair<std::string, std::string>> out;
        const auto add = [&](const char* name, const std::string& text) {
            if (!text.empty()) out.emplace_back(name, text);
        };
        add("Ship", ship());
        add("Ice", ice());
        if (speeds_.known()) add("Speed", speeds_.text() + " m/s (" + speeds_.knots() + " kn)");
        return out;
    }

private:
    // Keys that no summary has leave no gap in the text.
    std::string ship() {
        std::string text;
        append(text, "L ", "ship.length_m", " m");
        append(text, "B ", "ship.breadth_m", " m");
        append(text, "T ", "ship.draught_m", " m");
        append(text, "displacement ", "ship.displacement_kg", " t", 1e-3);
        append(text, "stem angle ", "ship.stem_angle_deg", "\u00b0");
        append(text, "half entrance angle ", "ship.entrance_angle_deg", "\u00b0");
        return text;
    }

    std::string ice() {
        std::string text;
        if (level_ > 0)
            text = broken_ == 0
                       ? "level ice"
                       : fmt::format("level ice in {} of {} runs", level_, level_ + broken_);
        append(text, "thickness ", "ice.thickness_m", " m");
        append(text, "pieces of ", "ice.floe_size_mean_m", " m on the average");
        append(text, "concentration ", "ice.concentration", " %", 100.0);
        append(text, "density ", "ice.density_kg_per_m3", " kg/m\u00b3");
        append(text, "friction on the ship ", "ice.friction_ship_ice", "");
        append(text, "ice on ice ", "ice.friction_ice_ice", "");
        if (level_ > 0) append_bending(text);
        const std::size_t before = text.size();
        append(text, "crushing pressure ", "ice.crushing_pressure_Pa", " MPa", 1e-6);
        // no run states a finite pressure
        if (!text.empty() && text.size() == before) text += ", rigid";
        return text;
    }

    void append_bending(std::string& text) {
        append(text, "flexural strength ", "ice.flexural_strength_Pa", " kPa", 1e-3);
        append(text, "elastic modulus ", "ice.elastic_modulus_Pa", " GPa", 1e-9);
        if (!models_.empty()) text += fmt::format(", bending model {}", fmt::join(models_, ", "));
        append(text, "factor on the breaking load ", "ice.bending_factor", "");
    }

    void append(std::string& text, const char* name, const char* key, const char* unit,
                double factor = 1.0) {
        const auto found = numbers_.find(key);
        if (found == numbers_.end() || !found->second.known()) return;
        text += (text.empty() ? "" : ", ") + (name + found->second.text(factor)) + unit;
    }

    std::map<std::string, Range> numbers_;
    std::set<std::string> models_;        // of bending
    std::size_t level_ = 0, broken_ = 0;  // runs in level ice and others
    Range speeds_;
};

}  // namespace

std::string head_facts(const Sweep& sweep) {
    const auto rows = Facts(sweep).rows();
    return rows.empty() ? "" : report::facts(rows);
}

}  // namespace ice::sweep
