// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// Where a row passes a triangle.
struct RowCrossing {
    double depth;       ///< along the row [m]
    std::int32_t row;   ///< i * count_v + j
    std::int32_t sign;  ///< +1: the row enters the solid, -1: it leaves
};

/// Rows along one axis, one in each cell of a grid across it. With axis 0, u is y and v is z;
/// and so on in cyclic order.
struct RowGrid {
    int axis = 0;              ///< 0, 1, 2 for x, y, z
    Vec3 low = Vec3::Zero();   ///< corner of the grid [m]; its component along axis unused
    Vec3 step = Vec3::Ones();  ///< size of the cells [m]
    std::int32_t count_u = 1, count_v = 1;
    bool scattered =
        false;  ///< at a random place of each cell (fixed seed), else at its low corner
};

/// All crossings, by row and then by depth. Neighbouring triangles decide a row on their edge the
/// same way, from the same bits, so that none slips through a closed mesh. Cost O(T + crossings
/// log crossings).
std::vector<RowCrossing> cross_rows(const TriangleMesh& mesh, const RowGrid& grid);

}  // namespace ice
