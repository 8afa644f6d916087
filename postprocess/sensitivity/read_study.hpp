// SPDX-License-Identifier: GPL-3.0-or-later
/// A folder of runs in which one input at a time differs from the case.
///
/// In:  run folders, and the plan runs.toml as the workflow writes it for a sensitivity study: that
///      of a sweep (sweep/read_sweep.hpp) with
///
///          [[run]]
///          name = "ice-density=920.0__seed=1"
///          input = "ice density"        # "" for the case itself
///          label = "920.0"
///          [[input]]
///          name = "ice density"
///          base = "900.0"               # the case's value
///          source = "..."               # of the range
///          [[left_out]]
///          name = "gap or saw cut"
///          why = "the case has no floes.gap"
///
/// Out: resistances by input and value, a number per seed.
#pragma once

#include "postprocess/sweep/read_sweep.hpp"

namespace ice::sensitivity {

/// Resistances of runs that differ in their seed only.
struct Seeds {
    std::string label;               ///< the input's value; "" for the case itself
    std::vector<double> resistance;  ///< of the completed runs [N; 2D: N/m]
    std::vector<double> half;        ///< their own 95 % half widths [N; 2D: N/m]; NaN: unknown
};

/// One input of the study.
struct Input {
    std::string name, base, source;  ///< its value in the case; source of its range
    std::vector<Seeds> values;       ///< in the plan's order
};

/// All runs of a study, by input and value.
struct Study {
    std::string title;
    int dimension = 3;       ///< 2 or 3
    bool level_ice = false;  ///< the ship of the case breaks it
    Seeds base;              ///< the case itself
    std::vector<Input> inputs;
    std::vector<std::pair<std::string, std::string>> left_out;  ///< input, why
    sweep::Sweep runs;                                          ///< all of them, for their faults
};

/// @throws Error (exit code 2) when there is no folder, runs.toml is missing, faulty or of a sweep,
///         or no run of the case itself completed.
Study read_study(const std::filesystem::path& folder);

}  // namespace ice::sensitivity
