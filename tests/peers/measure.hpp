// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/record/statistics.hpp"
#include "tests/peers/engine.hpp"

namespace ice::peers {

/// What a run of a case shows, measured alike for every engine: floes and hull are their polygons.
struct Outcome {
    MeanInterval force_x, force_z;  ///< of the ice on the ship from average_from on [N/m]
    int moved = 0;                  ///< floes released
    int behind = 0;                 ///< floes with their centre aft of the hull at the end
    int inside = 0;                 ///< floes that ever had their centre inside the hull
    double deepest_hull = 0.0;  ///< overlap of a floe with the hull, the largest of all steps [m]
    double deepest_ice = 0.0;   ///< of two floes [m]
    double peak = 0.0;          ///< largest force of one step on the ship [N/m]
    double fastest = 0.0;       ///< largest speed of a floe's centre [m/s]
    double imbalance = 0.0;     ///< Engine::imbalance() [N/m]
    double step_seconds = 0.0;  ///< wall time per step; for information
};

/// Runs a world in an engine to the end of its case.
Outcome measure(Engine& engine);

}  // namespace ice::peers
