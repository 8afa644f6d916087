// SPDX-License-Identifier: GPL-3.0-or-later
/// A folder of runs: settings and status of each run, and the settings that vary.
///
/// In:  run folders (summary.json, case.resolved.cfg), and the plan runs.toml where the workflow
///      wrote one:
///
///          title = "Paper 2D, resistance against speed"
///          axes = ["hull.speed", "simulation.seed"]
///          [[run]]
///          name = "hull.speed=0.5__simulation.seed=1"    # folder runs/NAME, log logs/NAME.log
///          values = {"hull.speed" = 0.5, "simulation.seed" = 1}
///
/// Out: one row per run, read by sweep_points.hpp.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/base/units.hpp"
#include "common/formats/summary_file.hpp"

namespace ice::sweep {

/// Keys that choose the member of an ensemble, of the case and of the ice field: no axes,
/// statistics run over them.
inline constexpr const char* kSeedKey = "simulation.seed";
inline constexpr const char* kFieldSeedKey = "field.seed";
bool is_seed(const std::string& key);

/// Key of the ship's speed [m/s]: x of every sweep in which it varies.
inline constexpr const char* kSpeedKey = "hull.speed";

/// Value of one setting: as text, and as a number where it is one (SI).
struct Setting {
    std::string text;
    std::optional<double> number;
};

/// Numbers by size, then texts by letters.
bool operator<(const Setting& a, const Setting& b);

/// One run, also one that failed or never began.
struct SweepRun {
    std::string name;              ///< of its folder, relative to the sweep's
    std::filesystem::path folder;  ///< may not exist
    std::map<std::string, Setting> settings;
    std::string status;              ///< summary.json's, or "failed", "not run", "unreadable"
    std::string fault;               ///< why there are no numbers; "" where there are
    std::optional<Summary> summary;  ///< of completed runs only

    /// Text of a setting, "" where the run has none.
    std::string text(const std::string& key) const;
};

/// All runs below a folder.
struct Sweep {
    std::filesystem::path folder;
    std::string title;
    std::vector<SweepRun> runs;         ///< in the plan's order, else by name
    std::vector<std::string> axes;      ///< keys that vary, without seeds and tied ones
    std::string x;                      ///< the axis curves run along; "" when none is a number
    std::vector<std::string> tied;      ///< keys that vary only together with x
    std::vector<std::string> planned;   ///< axes that the plan names; empty: found from the runs
    std::vector<std::string> warnings;  ///< e.g. run folders that the plan does not name
};

/// Reads the runs below `folder`.
///
/// With runs.toml its runs and axes count, and other run folders are left out with a warning;
/// without, every folder that holds a summary.json or case.resolved.cfg is a run, and its resolved
/// case names the settings that vary. x is hull.speed where that varies, else the number with most
/// values. An ensemble's folder (summary.json with `ensemble`) is no run: its members are, and keys
/// that differ between them, such as the field that a seed made, count as the seed.
/// A run that cannot be read becomes a row with its fault, never an error.
/// @throws Error (exit code 2) when there is no folder, no run, or runs.toml is faulty.
Sweep read_sweep(const std::filesystem::path& folder);

}  // namespace ice::sweep
