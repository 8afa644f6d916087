// SPDX-License-Identifier: GPL-3.0-or-later
/// Local loads of a run: peaks of the force on a region and loads on hull panels.
///
/// Forces are sums of normal forces' amounts (those from port and starboard do not cancel), as
/// means over one window of `window` seconds after the other: a force in a single step is an
/// impulse divided by the time step and grows without limit as the step shrinks. Newtons; in 2D
/// per metre of breadth.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// How often a level is exceeded.
struct Exceedance {
    double level = 0.0;     ///< [N], or [N/m] of a line load
    double per_hour = 0.0;  ///< peaks as large or larger [1/h of simulated time]
};

/// Peaks of a series: of the means between two up-crossings of their mean, the largest.
struct PeakStatistics {
    std::int64_t count = 0;
    double mean = 0.0, p99 = 0.0, max = 0.0;  ///< of the series [N], or [N/m] of a line load
    std::vector<Exceedance> exceeded;         ///< levels falling, rates rising; empty without peaks
};

/// A patch of the hull. Its line load is force / length, its mean pressure force / area.
struct PanelLoad {
    std::int32_t region = 0;                            ///< row of the hull's region names
    Vec3 center = Vec3::Zero(), normal = Vec3::Zero();  ///< ship frame [m]; outward, unit
    double area = 0.0;                                  ///< [m2]; 2D: per metre of breadth
    double length = 0.0;                      ///< along the waterline [m]; 2D: the metre of breadth
    double mean = 0.0, p99 = 0.0, max = 0.0;  ///< of the force [N]; 2D: [N/m]
};

/// All panels of a hull. Empty in files of versions that had none.
struct HullPanels {
    double size = 0.0;                    ///< edge of a whole panel [m]
    double window = 0.0;                  ///< [s]
    std::vector<std::int32_t> of_sphere;  ///< [S] row of `panels` per surface sphere
    std::vector<PanelLoad> panels;
};

}  // namespace ice
