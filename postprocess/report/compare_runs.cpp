// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/report/compare_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ice::report {

namespace {

const std::vector<std::string> kColumns{"run",         "mean_N",        "ci95_N", "contact_N",
                                        "friction_N",  "std_N",         "max_N",  "lindqvist_N",
                                        "floes_moved", "unconverged_%", "status"};

// the columns' values between the first and the last
std::vector<double> numbers_of(const Summary& s) {
    const double steps = std::max<double>(1.0, static_cast<double>(s.steps));
    return {s.resistance.mean,
            s.resistance.ci95,
            s.resistance.contact_mean,
            s.resistance.friction_mean,
            s.resistance.std,
            s.resistance.max,
            s.lindqvist_submersion.value_or(std::nan("")),
            static_cast<double>(s.floes_moved),
            100.0 * static_cast<double>(s.unconverged_steps) / steps};
}

// four digits are more than any interval is worth
std::string short_number(double value) {
    if (!std::isfinite(value)) return "-";
    const double size = std::abs(value);
    if (value == std::round(value)) return fmt::format("{:.0f}", value);
    const int before = size < 1.0 ? 1 : static_cast<int>(std::floor(std::log10(size))) + 1;
    return fmt::format("{:.{}f}", value, std::clamp(4 - before, 0, 2));
}

std::string csv_text(const std::string& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string out = "\"";
    for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
    return out + "\"";
}

}  // namespace

std::string compare_text(const std::vector<NamedSummary>& runs) {
    std::vector<std::vector<std::string>> rows{kColumns};
    for (const auto& [name, summary] : runs) {
        rows.push_back({name});
        for (const double value : numbers_of(summary)) rows.back().push_back(short_number(value));
        rows.back().push_back(summary.status);
    }
    std::vector<std::size_t> width(kColumns.size(), 0);
    for (const auto& row : rows)
        for (std::size_t k = 0; k < row.size(); ++k) width[k] = std::max(width[k], row[k].size());
    std::string out;
    for (const auto& row : rows) {
        for (std::size_t k = 0; k < row.size(); ++k) {
            const bool text = k == 0 || k + 1 == row.size();
            if (k > 0) out += "  ";
            out += text ? (k == 0 ? fmt::format("{:<{}}", row[k], width[k]) : row[k])
                        : fmt::format("{:>{}}", row[k], width[k]);
        }
        out += '\n';
    }
    return out;
}

std::string compare_csv(const std::vector<NamedSummary>& runs) {
    std::string out = fmt::format("{}\n", fmt::join(kColumns, ","));
    for (const auto& [name, summary] : runs) {
        out += csv_text(name);
        for (const double value : numbers_of(summary))
            out += "," + (std::isfinite(value) ? fmt::format("{}", value) : std::string());
        out += "," + summary.status + "\n";
    }
    return out;
}

}  // namespace ice::report
