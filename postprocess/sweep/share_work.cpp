// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/sweep/share_work.hpp"

#include <cmath>
#include <limits>
#include <string_view>

namespace ice::sweep {

namespace {

struct Entry {
    const char* title;
    std::string_view key;
    double sign;
};

// Entries that only runs in moving water, or with pieces held until they bend, have.
constexpr std::string_view kWaterWork = "water_work_J", kBreaking = "breaking_J";

// Entries of the energy ledger (section 8 of docs/method.md) with the sign that makes the first
// one the sum of all others: work of the ship = gains and losses less the energy that opened
// overlaps and moving water put in.
constexpr Entry kEntries[]{{"Work per metre", "ship_work_J", 1.0},
                           {"Potential", "potential_J", 1.0},
                           {"Kinetic", "kinetic_change_J", 1.0},
                           {"Friction", "friction_J", 1.0},
                           {"Impacts", "restitution_J", 1.0},
                           {"Crushing", "crushing_J", 1.0},
                           {"Breaking", kBreaking, 1.0},
                           {"Drag", "drag_J", 1.0},
                           {"Left-out moment", "buoyancy_moment_J", 1.0},
                           {"Opened overlap", "separation_J", -1.0},
                           {"Moving water", kWaterWork, -1.0}};

// [m], NaN when the speed is not one number
double travel(const SweepRun& run) {
    const auto speed = run.settings.find(kSpeedKey);
    if (speed == run.settings.end() || !speed->second.number)
        return std::numeric_limits<double>::quiet_NaN();
    return *speed->second.number * run.summary->simulated_s;
}

}  // namespace

std::vector<WorkShare> share_work(const Sweep& sweep, const Point& point) {
    std::vector<WorkShare> shares;
    for (const auto& [title, key, sign] : kEntries) {
        // energy per distance travelled is a force: means over the runs of the point
        double sum = 0.0;
        for (const std::size_t row : point.runs) {
            const SweepRun& run = sweep.runs[row];
            const auto energy = run.summary->energy.find(std::string(key));
            const bool entered = energy != run.summary->energy.end();
            // Entries that a case does not have are 0; any other that is missing makes the share
            // unknown.
            if ((key == kWaterWork || key == kBreaking) && !entered) continue;
            sum +=
                entered ? energy->second / travel(run) : std::numeric_limits<double>::quiet_NaN();
        }
        shares.push_back({title, sign * sum / static_cast<double>(point.runs.size())});
    }
    return shares;
}

}  // namespace ice::sweep
