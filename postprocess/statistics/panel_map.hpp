// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "postprocess/statistics/load_map.hpp"

namespace ice::statistics {

/// The largest pressure of each panel on the triangles of the hull that belong to it: a triangle is
/// of the panel of the sphere that is nearest to its centre.
/// @param mesh the hull in small triangles (LoadMap::mesh)
/// @return loads [Pa] for the triangles of `mesh`; an empty map for a run without panels or spheres
/// of the hull
LoadMap make_panel_map(const RunData& run, const TriangleMesh& mesh);

}  // namespace ice::statistics
