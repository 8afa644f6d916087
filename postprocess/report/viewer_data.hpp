// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "common/formats/run_file.hpp"
#include "postprocess/report/histories.hpp"
#include "postprocess/statistics/bottom_coverage.hpp"
#include "postprocess/statistics/load_map.hpp"

namespace ice::report {

/// The data of the page's script: see web/src/data.js.
struct ViewerData {
    std::string meta;    ///< JSON, safe inside HTML and XML
    std::string arrays;  ///< zlib, base64
};

/// Figures of a run for both drawings and viewer.
struct RunFigures {
    statistics::LoadMap load;
    statistics::BottomCoverage coverage;
    std::vector<History> histories;
    std::vector<History> regions, moments, motions;
    ForceUnit unit;             ///< of all forces of the page
    double average_from = 0.0;  ///< start of the statistics [s]
    int dimension = 3;          ///< 2 or 3
};

/// Packs at most `frames` frames, evenly chosen, the hull with its load map and regions, and the
/// histories.
///
/// Positions are rounded to 1/65000 of the field's extent or 1/1000 of the largest floe, whichever
/// is coarser; quaternions to 1/8191; forces on floes to 1/8191 of the square root's range. A run
/// without hull or frames gives empty arrays, and the page has no playback.
/// @param frames below 2 count as 2
ViewerData make_viewer_data(const RunData& run, const RunFigures& figures, std::size_t frames);

}  // namespace ice::report
