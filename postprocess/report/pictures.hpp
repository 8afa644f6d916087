// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "common/formats/run_file.hpp"
#include "postprocess/report/viewer_data.hpp"
#include "postprocess/views/scene_view.hpp"

namespace ice::report {

/// Views of hull and ice at several instants spread over the run: in 3D from below, above,
/// starboard and ahead; in 2D from the side. "" for a run without frames.
/// @param budget bytes; when a field is so large that the views need more, the least telling ones
///        are left out and the section says so
std::string scene_section(const RunData& run, std::size_t budget);

/// One chart of histories: averages bold, samples thin and cut where they leave the axis.
std::string draw_history(const History& history);

/// Coverage of the bottom against time.
std::string draw_coverage(const statistics::BottomCoverage& coverage);

/// Histories of the ship: resistance, each force component, coverage of the bottom.
std::string history_section(const RunData& run, const RunFigures& figures);

/// The hull's load map from below, starboard and ahead; "" for a run without hull contacts.
std::string load_section(const RunData& run, const RunFigures& figures);

/// Force histories of the tracked floes, those never touched by name only; "" without any.
std::string track_section(const RunData& run);

/// One picture by itself, with legend: the frame nearest to `time`.
/// @throws Error (exit code 2) for a run without frames.
std::string draw_view(const RunData& run, views::ViewFrom from, double time);

/// Options that suit every view of the run: breadth of the field, height of the water.
views::ViewOptions view_options(const RunData& run);

/// Paths of the tracked floes as the ship sees them.
std::vector<views::Trail> make_trails(const RunData& run);

}  // namespace ice::report
