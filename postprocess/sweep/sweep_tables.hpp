// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "postprocess/report/tables.hpp"
#include "postprocess/sweep/sweep_points.hpp"

namespace ice::sweep {

/// HTML: a link to a run's report, or to its folder where it has none. Of a run that never began it
/// is the text alone. The address is relative to the folder of `page`.
std::string link_to_run(const SweepRun& run, const std::string& text,
                        const std::filesystem::path& page);

/// HTML: a row per point with the axes' values, resistance with interval, parts and Lindqvist's
/// formula, and the runs as links to their reports (their folders, where they have none), relative
/// to the folder of `page`.
std::string point_table(const Sweep& sweep, const std::vector<Point>& points,
                        const report::ForceUnit& unit, const std::filesystem::path& page);

/// HTML: a row per point with the uses of the ship's work, per metre of travel (share_work.hpp).
/// "" where nothing is known. @pre there are points
std::string work_table(const Sweep& sweep, const std::vector<Point>& points,
                       const report::ForceUnit& unit);

/// HTML: a row per run with its status; runs without numbers have their fault in place of numbers.
std::string run_table(const Sweep& sweep, const report::ForceUnit& unit,
                      const std::filesystem::path& page);

/// CSV (RFC 4180): points with all digits in newtons, columns ..._N (2D: ..._N_per_m), intervals as
/// half widths, `affected_%` as the largest of the point's runs; unknown values are empty.
std::string point_csv(const Sweep& sweep, const std::vector<Point>& points);

/// CSV: all runs, failed ones with empty numbers and their fault; forces in newtons (2D: per
/// metre). `affected_%` is the largest share of the mean that a warning affects [%].
std::string run_csv(const Sweep& sweep);

/// Everything but letters, digits and -._~/ as %XX: a text as part of an address.
std::string encode_address(const std::string& text);

}  // namespace ice::sweep
