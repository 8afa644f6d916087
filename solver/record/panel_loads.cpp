// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/record/panel_loads.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/time_rounding.hpp"
#include "solver/record/find_peaks.hpp"

namespace ice {

namespace {

// Time of a window whose mean force counts [s]. A shorter one shows single hits, which depend on
// the step; a longer one averages pushes out of the peaks.
constexpr double kPanelWindow = 0.1;
// Steps of a window at least [-]: a window of fewer would still be single hits. More average pushes
// out of the peaks at long steps.
constexpr std::int64_t kLeastSteps = 5;
// Windows of a region kept at most [-]: 128 kB, 27 minutes of windows of 0.1 s. Fewer join windows
// sooner, and hits that follow each other closely count as one; more costs memory.
constexpr std::size_t kMostWindows = 16384;
// Panels in summary.json at most [-], beside the hardest of each region; run.h5 has all. A larger
// value makes the file longer, a smaller one leaves out hard hits.
constexpr std::size_t kMostPanels = 40;

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
      forces_(hull_.panels.size()),
      regions_(region_names_.size(), LongSeries(LongSeries::Join::largest, kMostWindows)),
      lines_(regions_) {
    hull_.window = static_cast<double>(steps_per_window_) * dt;
}

void PanelLoads::add(const std::vector<Contact>& contacts,
                     const std::vector<Constraint>& constraints, double time) {
    if (time < average_from_ - kTimeRounding) return;
    for (std::size_t k = 0; k < constraints.size(); ++k) {
        const Constraint& c = constraints[k];
        const double normal = c.total_normal();
        if (c.a != static_cast<std::int32_t>(kShip) || normal <= 0.0) continue;
        // by the region of the contact, which at an edge depends on its normal, and by the
        // sphere's panel
        on_region_[static_cast<std::size_t>(contacts[k].region)] += normal;
        if (hull_.panels.empty()) continue;
        const auto sphere = static_cast<std::size_t>(contacts[k].sphere_a);
        on_panel_[static_cast<std::size_t>(hull_.of_sphere[sphere])] += normal;
    }
    // Peaks are means over a window: the force of a single step depends on the step.
    if (++steps_ == steps_per_window_) close_window();
}

void PanelLoads::close_window() {
    for (std::size_t r = 0; r < on_region_.size(); ++r) {
        regions_[r].add(on_region_[r] / hull_.window);
        on_region_[r] = 0.0;
    }
    std::vector<double> lines(on_region_.size(), 0.0);
    // windows without a load are not stored: the quantile counts them
    for (std::size_t k = 0; k < on_panel_.size(); ++k) {
        if (on_panel_[k] <= 0.0) continue;
        const double force = on_panel_[k] / hull_.window;
        forces_[k].add(force);
        double& most = lines[static_cast<std::size_t>(hull_.panels[k].region)];
        most = std::max(most, force / hull_.panels[k].length);
        on_panel_[k] = 0.0;
    }
    for (std::size_t r = 0; r < lines.size(); ++r) lines_[r].add(lines[r]);
    steps_ = 0;
    ++windows_;
}

// Means are over all windows, those without a load included: a panel that is hit seldom has a small
// mean and a large maximum.
HullPanels PanelLoads::panels() const {
    HullPanels out = hull_;
    for (std::size_t k = 0; k < forces_.size(); ++k) {
        const WindowForces& forces = forces_[k];
        if (forces.empty()) continue;
        PanelLoad& panel = out.panels[k];
        panel.mean = forces.sum() / static_cast<double>(windows_);
        panel.max = forces.largest();
        panel.p99 = forces.quantile(0.99, windows_);
    }
    return out;
}

void PanelLoads::fill(Summary& summary) const {
    // a run shorter than a window has no peaks: the keys stay out
    if (windows_ == 0) return;
    for (std::size_t r = 0; r < region_names_.size(); ++r) {
        RegionStatistics& out = summary.regions[region_names_[r]];
        out.force_peaks = find_peaks(regions_[r], hull_.window);
        if (!hull_.panels.empty()) out.line_load_peaks = find_peaks(lines_[r], hull_.window);
    }
    const HullPanels all = panels();
    summary.panels.size = all.size;
    summary.panels.window = all.window;
    summary.panels.count = static_cast<std::int64_t>(all.panels.size());
    std::vector<PanelLoad> touched;
    for (const PanelLoad& panel : all.panels)
        if (panel.max > 0.0) touched.push_back(panel);
    summary.panels.touched = static_cast<std::int64_t>(touched.size());
    // by the line load, which a frame of the hull has to carry
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
