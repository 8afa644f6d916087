// SPDX-License-Identifier: GPL-3.0-or-later
/// What one unit of work costs in each of the solver's kernels.
#pragma once

#include <string>

#include "tests/bench/icebench_scene.hpp"

namespace ice::bench {

/// Least times of several runs, one thread, the instruction set in force now [ns].
struct KernelTimes {
    std::string simd;
    double pair_test = 0.0;    ///< find_near_pairs, per two spheres, none of them near
    double hull_sphere = 0.0;  ///< PairSearch at the hull, per sphere of a floe beside it
    double fresh_pair = 0.0;   ///< ContactFinder::find, per two floes near each other, from nothing
    double known_pair = 0.0;   ///< the same within a run, where what was found before is known
    double sweep_contact = 0.0;  ///< sweep, per contact
};

/// Measures the kernels on a scene's state after `steps` steps.
KernelTimes measure_kernels(const BenchScene& scene, int steps);

/// Head of the table, and one line of it; markdown.
std::string kernel_head();
std::string kernel_line(const KernelTimes& times);

}  // namespace ice::bench
