// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/report/compare_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/base/error.hpp"
#include "common/formulas/formula_band.hpp"

namespace ice::report {

namespace {

// forces of a 2D run are per metre of breadth, which the names say
std::vector<std::string> columns_of(int dimension) {
    std::vector<std::string> names{"run"};
    for (const char* force : {"mean", "ci95", "contact", "friction", "std", "max", "lindqvist"})
        names.push_back(std::string(force) + (dimension == 2 ? "_N_per_m" : "_N"));
    // beside forces the numbers by which a run is trusted
    names.insert(names.end(), {"floes_moved", "unconverged_%", "hold", "status", "affected_%"});
    return names;
}

// Lindqvist's estimate of the run's mean: the total in level ice, which the ship breaks, and the
// submersion part alone in ice that is broken already [N]; NaN: not evaluated.
double lindqvist_of(const Summary& s) {
    if (!is_level_ice(s.ice)) return s.lindqvist_submersion.value_or(std::nan(""));
    for (const FormulaValue& f : s.formulas)
        if (f.name == kLindqvist && f.part == kTotal) return f.value;
    return std::nan("");
}

// the columns' values between the first and the last three
std::vector<double> numbers_of(const Summary& s) {
    // a run that ended before its first step has a share of 0, not a division by 0
    const double steps = std::max<double>(1.0, static_cast<double>(s.steps));
    return {s.resistance.mean,
            s.resistance.ci95,
            s.resistance.contact_mean,
            s.resistance.friction_mean,
            s.resistance.std,
            s.resistance.max,
            lindqvist_of(s),
            static_cast<double>(s.floes_moved),
            100.0 * static_cast<double>(s.unconverged_steps) / steps};
}

// by how much warnings affect the mean [%]; NaN: not measured
double affected_percent(const Summary& s) {
    return 100.0 * affected_share(s.warnings).value_or(std::nan(""));
}

// four digits are more than any interval is worth
std::string short_number(double value) {
    if (!std::isfinite(value)) return "-";
    const double size = std::abs(value);
    if (value == std::round(value)) return fmt::format("{:.0f}", value);
    // digits before the point, so that small and large numbers show about as many in all
    const int before = size < 1.0 ? 1 : static_cast<int>(std::floor(std::log10(size))) + 1;
    return fmt::format("{:.{}f}", value, std::clamp(4 - before, 0, 2));
}

// all digits; nothing where the value is unknown
std::string csv_number(double value) {
    return std::isfinite(value) ? fmt::format("{}", value) : std::string();
}

std::string csv_text(const std::string& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string out = "\"";
    for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
    return out + "\"";
}

std::vector<NamedSummary> of_dimension(const std::vector<NamedSummary>& runs, int dimension) {
    std::vector<NamedSummary> out;
    for (const NamedSummary& run : runs)
        if (run.second.dimension == dimension) out.push_back(run);
    return out;
}

std::string one_table(const std::vector<NamedSummary>& runs, int dimension) {
    const auto columns = columns_of(dimension);
    std::vector<std::vector<std::string>> rows{columns};
    for (const auto& [name, summary] : runs) {
        rows.push_back({name});
        for (const double value : numbers_of(summary)) rows.back().push_back(short_number(value));
        rows.back().push_back(release_rule(summary.ice));
        rows.back().push_back(summary.status);
        rows.back().push_back(short_number(affected_percent(summary)));
    }
    std::vector<std::size_t> width(columns.size(), 0);
    for (const auto& row : rows)
        for (std::size_t k = 0; k < row.size(); ++k) width[k] = std::max(width[k], row[k].size());
    std::string out;
    for (const auto& row : rows) {
        for (std::size_t k = 0; k < row.size(); ++k) {
            // texts begin in one column, numbers end in one
            const bool text = k == 0 || columns[k] == "hold" || columns[k] == "status";
            if (k > 0) out += "  ";
            out += text ? fmt::format("{:<{}}", row[k], width[k])
                        : fmt::format("{:>{}}", row[k], width[k]);
        }
        out += '\n';
    }
    return out;
}

}  // namespace

std::string compare_text(const std::vector<NamedSummary>& runs) {
    const auto solid = of_dimension(runs, 3), flat = of_dimension(runs, 2);
    if (flat.empty()) return one_table(solid, 3);
    return (solid.empty() ? "" : one_table(solid, 3) + "\n") + one_table(flat, 2);
}

std::string compare_csv(const std::vector<NamedSummary>& runs) {
    const auto solid = of_dimension(runs, 3), flat = of_dimension(runs, 2);
    if (!solid.empty() && !flat.empty())
        // a table of whole forces and of forces per metre would invite comparing them
        throw bad_input(fmt::format("{} and {}", solid.front().first, flat.front().first),
                        "are in 3D and in 2D: newtons and newtons per metre share no column",
                        "give runs of one dimension to a table with --csv");
    std::string out = fmt::format("{}\n", fmt::join(columns_of(flat.empty() ? 3 : 2), ","));
    for (const auto& [name, summary] : runs) {
        out += csv_text(name);
        for (const double value : numbers_of(summary)) out += "," + csv_number(value);
        out += "," + csv_text(release_rule(summary.ice)) + "," + summary.status + "," +
               csv_number(affected_percent(summary)) + "\n";
    }
    return out;
}

}  // namespace ice::report
