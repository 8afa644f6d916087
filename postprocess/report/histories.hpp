// SPDX-License-Identifier: GPL-3.0-or-later
/// Force histories ready to be drawn: as SVG (history_section.cpp) and by the viewer.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/formats/run_file.hpp"
#include "postprocess/report/tables.hpp"

namespace ice::report {

/// One chart: curves over a common time, in one unit.
struct History {
    struct Curve {
        std::string name;
        const char* color;           ///< "#rrggbb"
        std::vector<double> values;  ///< in `unit`
        bool average = false;        ///< a moving average, not the samples themselves
    };
    std::string id;  ///< for links; unique
    std::string title, y_title;
    ForceUnit unit;
    std::vector<double> time;      ///< [s], rising; at least 2
    std::vector<Curve> curves;     ///< each with as many values as times
    double low = 0.0, high = 0.0;  ///< range of the axis, in `unit`
    std::optional<double> mean;    ///< a line across, in `unit`
};

/// Histories of the force on the ship: the resistance, then contact and friction along x, y and z
/// (2D: x and z) as samples and moving averages.
///
/// A one-step peak is an impulse divided by the time step and leaves nothing else to see where it
/// is shown whole. So the axes cover the middle 96 % of the averages from `average_from` [s] on,
/// and the page states the largest hits. Samples are thinned with every peak kept.
/// @param mean of the resistance [N], NaN if unknown; @param unit of all charts
/// A run with fewer than 2 samples gives none.
std::vector<History> force_histories(const RunData& run, double average_from, double mean,
                                     const ForceUnit& unit);

/// Moving averages of the force on each region of the hull: the part of the resistance that each
/// bears, lateral (3D) and vertical force. Of more than 7 regions those with the largest mean
/// forces are shown. A run that did not record them gives none.
std::vector<History> region_histories(const RunData& run, double average_from,
                                      const ForceUnit& unit);

/// Moving averages of the moments of the ice on the ship about the hull mesh's origin, heel, trim
/// and yaw (2D: trim), in `unit` times metre. None for fewer than 2 samples.
std::vector<History> moment_histories(const RunData& run, double average_from,
                                      const ForceUnit& unit);

/// Motions of a free ship: speed, thrust and tow, height, angles, where they change. None
/// for a prescribed course, or for fewer than 2 samples. @param unit of thrust and tow; speed
/// [m/s], height [m] and angles [degrees] have their own
std::vector<History> motion_histories(const RunData& run, double average_from,
                                      const ForceUnit& unit);

/// Contact and friction of a tracked floe (row of run.tracks) on the ship, two charts, coarser; the
/// axes show all averages. A floe that never touched the ship gives none.
std::vector<History> track_histories(const RunData& run, std::size_t track, const ForceUnit& unit);

/// Window of all moving averages [s]: a thirtieth of the run, cut to one digit, but at least 5
/// samples; 1 s for fewer than 2 samples.
double average_window(const std::vector<HistoryRow>& history);

}  // namespace ice::report
