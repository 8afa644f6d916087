// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/run/describe_cost.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/base/error.hpp"
#include "common/base/timer.hpp"
#include "common/formats/run_file.hpp"

namespace ice {

namespace {

// Rows of run.h5 [bytes]: one of the ship's history has 25 numbers, one of a tracked floe 22, one
// of a region 6 floats. A number in a table takes some 12 bytes of text. Every step's forces stay
// in memory for the statistics (record/run_statistics.hpp). Larger values announce larger files and
// more memory; the run is the same.
constexpr double kShipRow = 25 * 8, kTrackRow = 22 * 8, kRegionRow = 6 * 4;
constexpr double kShipText = 11 * 12, kTrackText = 23 * 12, kStepMemory = 64;

// Files that HDF5, the log, the libraries and the terminal keep open [-]. A larger value raises the
// limit of open files earlier; with too small a one, files of tracked floes cannot be opened.
constexpr rlim_t kOtherFiles = 32;

// Trial steps that the time of a step is measured by [-]: at most so many, begun within this time
// [s]. Larger values measure it better and make the start later.
constexpr int kMostSteps = 50;
constexpr double kMostSeconds = 0.5;

std::string bytes_text(double bytes) {
    static constexpr std::array<const char*, 4> kUnits{"kB", "MB", "GB", "TB"};
    std::size_t unit = 0;
    for (bytes /= 1e3; bytes >= 1e3 && unit + 1 < kUnits.size(); ++unit) bytes /= 1e3;
    return bytes < 10.0 ? fmt::format("{:.2g} {}", bytes, kUnits[unit])
                        : fmt::format("{:.0f} {}", bytes, kUnits[unit]);
}

std::string time_text(double seconds) {
    if (seconds < 100.0) return fmt::format("{:.2g} s", seconds);
    if (seconds < 6000.0) return fmt::format("{:.0f} min", seconds / 60.0);
    if (seconds < 3600.0 * 100.0) return fmt::format("{:.2g} h", seconds / 3600.0);
    return fmt::format("{:.0f} days", seconds / 86400.0);
}

}  // namespace

RunCost run_cost(const Case& p, std::size_t floes, std::size_t regions) {
    RunCost out;
    // rows and frames are written at steps alone
    out.steps = std::llround(p.duration / p.time_step);
    out.rows = std::llround(p.duration / std::max(p.history_every, p.time_step));
    out.frames = 1 + std::llround(p.duration / std::max(p.frames_every, p.time_step));
    const auto rows = static_cast<double>(out.rows), tracked = static_cast<double>(p.track.size());
    out.run_file =
        rows * (kShipRow + kTrackRow * tracked + kRegionRow * static_cast<double>(regions)) +
        static_cast<double>(out.frames) * static_cast<double>(kFrameFloeBytes) *
            static_cast<double>(floes);
    out.tables = rows * (kShipText + kTrackText * tracked);
    out.memory = kStepMemory * static_cast<double>(out.steps);
    return out;
}

std::string describe_cost(World& w) {
    const RunCost cost = run_cost(w.parameters, w.scene.bodies.size() - 1,
                                  w.scene.shapes[kShip].region_names.size());
    const Timer timer;
    // as many steps as half a second allows, at least two
    int taken = 0;
    for (; taken < std::min<std::int64_t>(kMostSteps, cost.steps); ++taken) {
        // the first step also fills lists and caches: one more is needed for a fair time
        if (taken > 1 && timer.seconds() > kMostSeconds) break;
        step(w);
    }
    const double each = timer.seconds() / std::max(taken, 1);
    const std::string output = fmt::format(
        "\n  output     {} rows, {} frames: run.h5 {} before it is compressed, tables {}",
        cost.rows, cost.frames, bytes_text(cost.run_file), bytes_text(cost.tables));
    // The first steps find no pieces, which are most of the work and of the memory.
    if (w.edge.has_sheet())
        return fmt::format(
            "  cost       {} steps, the first ones of {:.2g} ms; those in the ice take many times "
            "as "
            "long{}",
            cost.steps, 1e3 * each, output);
    return fmt::format(
        "  cost       {} at least: {} steps, the first ones of {:.2g} ms; with ice along the hull "
        "they take longer{}, memory {}",
        time_text(each * static_cast<double>(cost.steps)), cost.steps, 1e3 * each, output,
        bytes_text(cost.memory));
}

void require_open_files(const Case& parameters) {
    // the soft limit may be raised to the hard one without privileges
    const rlim_t wanted = parameters.track.size() + kOtherFiles;
    rlimit limit{};
    if (getrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur >= wanted) return;
    limit.rlim_cur = std::min(limit.rlim_max, wanted);
    if (setrlimit(RLIMIT_NOFILE, &limit) == 0 && limit.rlim_cur >= wanted) return;
    throw bad_input("output.track",
                    fmt::format("{} floes need {} open files, {} are allowed",
                                parameters.track.size(), wanted, limit.rlim_cur),
                    fmt::format("track fewer floes, or allow more: ulimit -n {}", wanted));
}

}  // namespace ice
