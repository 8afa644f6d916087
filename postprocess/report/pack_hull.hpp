// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "postprocess/report/pack.hpp"
#include "postprocess/statistics/load_map.hpp"

namespace ice::report {

/// Packs the hull of a load map: vertices, triangles, the regions' numbers and the loads. Returns
/// their description as web/src/data.js reads it.
///
/// Vertices are rounded to 1/65000 of the hull's extent along each axis. Loads are shares of
/// statistics::scale_end() [-], so that the viewer has the colours of the drawings; larger ones
/// count as 1. An empty map gives empty arrays.
nlohmann::json pack_hull(const statistics::LoadMap& hull, Pack& pack);

}  // namespace ice::report
