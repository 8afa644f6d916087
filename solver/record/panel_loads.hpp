// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "common/formats/summary_file.hpp"
#include "solver/contact/constraints.hpp"
#include "solver/record/long_series.hpp"
#include "solver/record/window_forces.hpp"

namespace ice {

class CheckpointFile;

/// Collects normal forces on the hull's panels and regions as means over windows
/// (formats/load_statistics.hpp), from the start of the statistics on.
class PanelLoads {
public:
    /// Windows are of 0.1 s, in whole steps, but of at least 5 steps.
    /// @param hull panels with zero loads (divide_hull.hpp) @param average_from [s] @param dt [s]
    PanelLoads(HullPanels hull, std::vector<std::string> region_names, double average_from,
               double dt);

    /// Adds the impulses of a step that ended at `time` [s]. @param contacts one per constraint
    void add(const std::vector<Contact>& contacts, const std::vector<Constraint>& constraints,
             double time);

    /// Panels with the statistics of all whole windows so far.
    HullPanels panels() const;
    /// Fills in the peaks of the regions, and of the panels the hardest of each region and the 40
    /// hardest of all, by their largest line load; panels that nothing touched are left out.
    void fill(Summary& summary) const;

    /// Writes or sets its state, by the file's direction (recorder_state.cpp).
    void carry(CheckpointFile& file);

private:
    void close_window();
    HullPanels hull_;
    std::vector<std::string> region_names_;
    double average_from_, dt_;
    std::int64_t steps_per_window_;

    std::int64_t steps_ = 0, windows_ = 0;      ///< steps: of the window that is not whole yet
    std::vector<double> on_panel_, on_region_;  ///< impulses in it [N s]
    std::vector<WindowForces> forces_;          ///< by panel, of whole windows, above zero [N]
    std::vector<LongSeries> regions_;           ///< by region, force of each window [N]
    std::vector<LongSeries> lines_;             ///< by region, line load of its hardest panel [N/m]
};

}  // namespace ice
