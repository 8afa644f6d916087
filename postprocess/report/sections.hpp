// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "common/formats/run_file.hpp"
#include "postprocess/report/viewer_data.hpp"
#include "postprocess/views/scene_view.hpp"

namespace ice::report {

/// Mean speed of the ship over the samples from `from` on [m/s]; NaN for fewer than two.
double mean_speed(const RunData& run, double from);

/// The answer as cards: resistance with interval and model uncertainty, formulas, release rule,
/// speed, effective power. @param speed [m/s], NaN if unknown
std::string key_numbers(const Summary& summary, const ForceUnit& unit, double speed);

/// Ship, ice and travel in three short tables; values missing in older summaries are left out.
std::string particulars_section(const Summary& summary, double speed);

/// Views of hull and ice at several instants spread over the run: in 3D from below, above,
/// starboard and ahead; in 2D from the side. "" for a run without frames.
/// @param budget [bytes]; when a field is so large that the views need more, the last ones in this
///        order are left out and the section says so. Those from below and above at the last
///        instant are there in any case
std::string scene_section(const RunData& run, std::size_t budget);

/// One chart of histories, 480 x 240 px: averages bold, samples thin and cut where they leave the
/// axis.
std::string draw_history(const History& history);

/// Coverage of the bottom [%] against time [s]; "no data" without frames.
std::string draw_coverage(const statistics::BottomCoverage& coverage);

/// Histories of the ship: resistance, each force component, coverage of the bottom.
std::string history_section(const RunData& run, const RunFigures& figures);

/// Regions of the hull: their table, then forces against time. "" without both.
std::string region_section(const RunFigures& figures, const std::string& table);

/// Point of attack of the mean force and moments against time; "" for a run without histories.
std::string moment_section(const RunData& run, const RunFigures& figures);

/// Speed, drive, height and angles of a free ship against time; "" for a prescribed course.
std::string motion_section(const RunData& run, const RunFigures& figures);

/// Peaks of the force on regions, line load and pressure on hull panels, with the hardest-loaded
/// panels drawn; "" for a run without them.
/// @param lengths that the ship travelled in the averaged time [ship lengths], NaN if unknown
std::string local_load_section(const read::RunFolder& run, const RunFigures& figures,
                               double lengths);

/// Loads on the hull's triangles from several sides, with their legend.
/// @param end load of the darkest colour [Pa]; @param what the colours mean
std::string draw_hull_loads(const RunData& run, const statistics::LoadMap& map, double end,
                            const std::string& what);

/// The hull's load map from below, starboard and ahead; "" for a run without hull contacts.
std::string load_section(const RunData& run, const RunFigures& figures);

/// Force histories of the tracked floes, folded, those never touched by name only; "" without any.
std::string track_section(const RunData& run, const ForceUnit& unit);

/// One picture by itself, with legend: the frame nearest to `time` [s], the first or the last
/// beyond the run.
/// @throws Error (exit code 2) for a run without frames.
std::string draw_view(const RunData& run, views::ViewFrom from, double time);

/// Options that suit every view of the run: breadth of the field, height of the water. The defaults
/// for a run without frames.
views::ViewOptions view_options(const RunData& run);

/// Paths of the tracked floes as the ship sees them, up to about 1000 points each; none without
/// any.
std::vector<views::Trail> make_trails(const RunData& run);

}  // namespace ice::report
