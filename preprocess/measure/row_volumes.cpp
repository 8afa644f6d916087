// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/measure/row_volumes.hpp"

#include "preprocess/measure/row_crossings.hpp"

namespace ice {

namespace {

RowVolume integrate(const std::vector<RowCrossing>& crossings, double area) {
    RowVolume out;
    for (std::size_t k = 0; k < crossings.size();) {
        int winding = 0, count = 0;
        const std::int32_t row = crossings[k].row;
        for (; k < crossings.size() && crossings[k].row == row; ++k, ++count) {
            // from the crossing before to this one, over the row's cell: three readings, which
            // differ where the surface crosses itself
            const double behind =
                count == 0 ? 0.0 : area * (crossings[k].depth - crossings[k - 1].depth);
            out.by_sign += winding * behind;
            if (winding > 0) out.by_winding += behind;
            if (count % 2 == 1) out.by_parity += behind;
            winding += crossings[k].sign;
        }
        // on a closed surface a row leaves as often as it enters
        if (winding != 0) ++out.open_rows;
    }
    return out;
}

}  // namespace

std::array<RowVolume, 3> measure_rows(const TriangleMesh& mesh, int rows) {
    Eigen::AlignedBox3d box;
    for (const Vec3& v : mesh.vertices) box.extend(v);
    std::array<RowVolume, 3> out;
    if (mesh.triangles.empty() || box.sizes().minCoeff() <= 0.0) return out;
    // along three axes: an opening that no row of one axis meets changes the volume along another
    for (int axis = 0; axis < 3; ++axis) {
        const Vec3 step = box.sizes() / rows;
        const RowGrid grid{axis, box.min(), step, rows, rows, true};
        out[static_cast<std::size_t>(axis)] =
            integrate(cross_rows(mesh, grid), step[(axis + 1) % 3] * step[(axis + 2) % 3]);
    }
    return out;
}

}  // namespace ice
