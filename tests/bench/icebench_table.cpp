// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/icebench_table.hpp"

#include <fmt/format.h>

#include <cmath>

namespace ice::bench {

namespace {

constexpr const char* kLine =
    "| {:<16} | {:<9} | {:>5} | {:>7} | {:<6} | {:>5} | {:>8} | {:>9} | {:>9} | {:>9} | {:>8} | "
    "{:>10} | "
    "{:>8} | "
    "{:>14} | {:>16} | {:>14} |\n";
constexpr const char* kStageLine = "| {:<16} | {:<9} | {:>5} | {:>7} | {:<6} |";

}  // namespace

std::string table_head() {
    return fmt::format(kLine, "engine", "scene", "floes", "threads", "simd", "steps", "ms, min",
                       "median", "mean", "cpu", "contacts", "overlap mm", "energy J",
                       "above input J", "state hash", "to ours") +
           "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
}

std::string table_line(const Row& row, const std::string& to_ours) {
    const std::string above =
        std::isnan(row.energy_above_input) ? "" : fmt::format("{:.3g}", row.energy_above_input);
    return fmt::format(
        kLine, row.engine, row.scene, row.floes, row.threads, row.simd, row.step_ms.size(),
        fmt::format("{:.4f}", row.least_ms()), fmt::format("{:.4f}", row.median_ms()),
        fmt::format("{:.4f}", row.mean_ms()), fmt::format("{:.4f}", row.mean_cpu_ms()),
        fmt::format("{:.1f}", row.contacts), fmt::format("{:.3f}", 1e3 * row.max_overlap),
        fmt::format("{:.1f}", row.energy), above, row.state_hash, to_ours);
}

std::string stage_table(const std::vector<Row>& rows) {
    std::string out = fmt::format(kStageLine, "engine", "scene", "floes", "threads", "simd");
    std::string rule = "|---|---|---|---|---|";
    for (const char* stage : kStageNames) {
        out += fmt::format(" {:>9} |", stage);
        rule += "---|";
    }
    out += "\n" + rule + "\n";
    for (const Row& row : rows) {
        if (row.stage_ms.empty()) continue;
        out += fmt::format(kStageLine, row.engine, row.scene, row.floes, row.threads, row.simd);
        for (const double ms : row.stage_ms) out += fmt::format(" {:>9.4f} |", ms);
        out += "\n";
    }
    return out;
}

std::string csv_text(const std::vector<Row>& rows) {
    std::string out =
        "engine,scene,floes,threads,simd,ms_min,ms_median,contacts,max_overlap_mm,energy_J,"
        "state_hash\n";
    for (const Row& row : rows)
        out += fmt::format("{},{},{},{},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{}\n", row.engine,
                           row.scene, row.floes, row.threads, row.simd, row.least_ms(),
                           row.median_ms(), row.contacts, 1e3 * row.max_overlap, row.energy,
                           row.state_hash);
    return out;
}

}  // namespace ice::bench
