// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/record/panel_loads.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "solver/record/find_peaks.hpp"

namespace ice {

namespace {

constexpr double kPanelWindow = 0.1;     // [s]
constexpr std::int64_t kLeastSteps = 5;  // a window of fewer would still be single hits
constexpr std::size_t kMostPanels = 40;  // in summary.json; run.h5 has all

}  // namespace

PanelLoads::PanelLoads(HullPanels hull, std::vector<std::string> region_names, double average_from,
                       double dt)
    : hull_(std::move(hull)),
      region_names_(std::move(region_names)),
      average_from_(average_from),
      dt_(dt),
      steps_per_window_(std::max<std::int64_t>(kLeastSteps, std::llround(kPanelWindow / dt))),
      on_panel_(hull_.panels.size(), 0.0),
      on_region_(region_names_.size(), 0.0),
      forces_(hull_.panels.size()) {
    hull_.window = static_cast<double>(steps_per_window_) * dt;
}

void PanelLoads::add(const std::vector<Contact>& contacts,
                     const std::vector<Constraint>& constraints, double time) {
    if (time < average_from_ - 1e-9) return;
    for (std::size_t k = 0; k < constraints.size(); ++k) {
        const Constraint& c = constraints[k];
        const double normal = c.total_normal();
        if (c.a != static_cast<std::int32_t>(kShip) || normal <= 0.0) continue;
        on_region_[static_cast<std::size_t>(contacts[k].region)] += normal;
        if (hull_.panels.empty()) continue;
        const auto sphere = static_cast<std::size_t>(contacts[k].sphere_a);
        on_panel_[static_cast<std::size_t>(hull_.of_sphere[sphere])] += normal;
    }
    // Peaks are means over a window: the force of a single step depends on the step.
    if (++steps_ == steps_per_window_) close_window();
}

void PanelLoads::close_window() {
    for (double& impulse : on_region_) {
        regions_.push_back(impulse / hull_.window);
        impulse = 0.0;
    }
    lines_.resize(regions_.size(), 0.0);
    double* line = lines_.data() + lines_.size() - on_region_.size();
    for (std::size_t k = 0; k < on_panel_.size(); ++k) {
        if (on_panel_[k] <= 0.0) continue;
        const double force = on_panel_[k] / hull_.window;
        forces_[k].push_back(force);
        double& most = line[hull_.panels[k].region];
        most = std::max(most, force / hull_.panels[k].length);
        on_panel_[k] = 0.0;
    }
    steps_ = 0;
    ++windows_;
}

HullPanels PanelLoads::panels() const {
    HullPanels out = hull_;
    for (std::size_t k = 0; k < forces_.size(); ++k) {
        std::vector<double> forces = forces_[k];
        if (forces.empty()) continue;
        PanelLoad& panel = out.panels[k];
        panel.mean =
            std::accumulate(forces.begin(), forces.end(), 0.0) / static_cast<double>(windows_);
        panel.max = *std::max_element(forces.begin(), forces.end());
        // Windows without a load were not stored; a quantile over time counts them as zero.
        forces.resize(static_cast<std::size_t>(windows_), 0.0);
        panel.p99 = quantile(std::move(forces), 0.99);
    }
    return out;
}

std::vector<double> PanelLoads::on_region(const std::vector<double>& table,
                                          std::size_t region) const {
    std::vector<double> series;
    for (std::size_t at = region; at < table.size(); at += region_names_.size())
        series.push_back(table[at]);
    return series;
}

void PanelLoads::fill(Summary& summary) const {
    if (windows_ == 0) return;
    for (std::size_t r = 0; r < region_names_.size(); ++r) {
        RegionStatistics& out = summary.regions[region_names_[r]];
        out.force_peaks = find_peaks(on_region(regions_, r), hull_.window);
        if (!hull_.panels.empty())
            out.line_load_peaks = find_peaks(on_region(lines_, r), hull_.window);
    }
    const HullPanels all = panels();
    summary.panels.size = all.size;
    summary.panels.window = all.window;
    summary.panels.count = static_cast<std::int64_t>(all.panels.size());
    std::vector<PanelLoad> touched;
    for (const PanelLoad& panel : all.panels)
        if (panel.max > 0.0) touched.push_back(panel);
    summary.panels.touched = static_cast<std::int64_t>(touched.size());
    std::stable_sort(touched.begin(), touched.end(), [](const PanelLoad& a, const PanelLoad& b) {
        return a.max / a.length > b.max / b.length;
    });
    std::vector<char> seen(region_names_.size(), 0);
    for (std::size_t k = 0; k < touched.size(); ++k) {
        const auto region = static_cast<std::size_t>(touched[k].region);
        // The hardest of all, and of each region at least one, so that a quiet region is not
        // missing.
        if (k >= kMostPanels && seen[region]) continue;
        seen[region] = 1;
        summary.panels.hardest.emplace_back(region_names_[region], touched[k]);
    }
}

}  // namespace ice
