// SPDX-License-Identifier: GPL-3.0-or-later
/// Local loads as JSON: the keys of summary.json that load_statistics.hpp describes.
#pragma once

#include "common/formats/json_file.hpp"
#include "common/formats/summary_file.hpp"

namespace ice {

/// "force_peaks" and "line_load_peaks" of a region, where it has them.
void add_peaks(const RegionStatistics& region, Json& out);

/// @throws Json::exception where a key is missing or has the wrong type; without peaks nothing is
/// set
void read_peaks(const Json& region, RegionStatistics& out);

/// "panel_rule" and "panels".
void add_panels(const PanelSummary& panels, Json& out);

/// Empty without the key "panels". @throws Json::exception as read_peaks()
PanelSummary read_panels(const Json& summary);

}  // namespace ice
