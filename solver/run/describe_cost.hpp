// SPDX-License-Identifier: GPL-3.0-or-later
/// Estimates the cost of a run: time, disk, memory, open files.
#pragma once

#include <cstdint>
#include <string>

#include "solver/step/step.hpp"

namespace ice {

/// Upper bound of a run's files and memory, before run.h5 is compressed. Touches of hull and floes,
/// whose number is not known beforehand, are not in it.
struct RunCost {
    std::int64_t steps = 0, rows = 0, frames = 0;  ///< of the run, of each history, poses stored
    double run_file = 0.0;                         ///< run.h5 [B]
    double tables = 0.0;                           ///< forces.csv and those of tracked floes [B]
    double memory = 0.0;                           ///< beside the scene [B]
};
RunCost run_cost(const Case& parameters, std::size_t floes, std::size_t regions);

/// One line for `icesolve --check`: time from some first steps, which the world has then made, disk
/// and memory. The time is a lower bound if the ship has not met the ice yet; the line states this.
std::string describe_cost(World& world);

/// Allows the run the files that it keeps open, one for each tracked floe and some more: raises the
/// process's soft limit as far as needed.
/// @throws Error (exit code 2) naming output.track where the hard limit is lower
void require_open_files(const Case& parameters);

}  // namespace ice
