// SPDX-License-Identifier: GPL-3.0-or-later
/// What icebench measures of one engine on one scene.
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "tests/bench/icebench_scene.hpp"

namespace ice::bench {

/// One row of the table. What an engine does not tell is NaN or empty.
struct Row {
    std::string engine, scene;
    int floes = 0, threads = 1;
    std::string simd;                 ///< instruction set
    std::vector<double> step_ms;      ///< wall time of every step [ms]; fewer where time ran out
    std::vector<double> step_cpu_ms;  ///< processor time of all its threads [ms]
    double contacts = 0.0;            ///< that carried an impulse, mean over the steps
    double max_overlap = 0.0;         ///< deepest at the start of any step [m]
    double energy = 0.0;              ///< kinetic energy of the floes at the end [J]
    /// Largest kinetic and potential energy above that at the start and the ship's work [J].
    double energy_above_input = std::numeric_limits<double>::quiet_NaN();
    std::string state_hash;        ///< of the end, 16 hexadecimal digits
    std::vector<double> stage_ms;  ///< mean per step, in the order of kStageNames
    bool interrupted = false;

    double least_ms() const;
    double median_ms() const;
    double mean_ms() const;
    double mean_cpu_ms() const;
};

/// How long to measure.
struct Length {
    int steps = 1000;
    double patience = 150.0;  ///< of a peer: no step begins after this wall time [s]
};

/// Told after every step which share is done; false ends the measurement.
using Watch = std::function<bool(double fraction)>;

/// Our solver on a scene, with the threads and instruction set in force now. Only step() is timed.
Row measure_solver(const BenchScene& scene, int steps, const Watch& watch);

/// Another engine that can do a wedge scene.
struct PeerKind;
Row measure_peer(const PeerKind& kind, const BenchScene& scene, const Length& length,
                 const Watch& watch);

/// The peer's processor time over ours for the same steps from the start on. By the clock, other
/// programs on the machine would count: a peer's long steps have to share it, our short ones not.
double ratio(const Row& peer, const Row& ours);

}  // namespace ice::bench
