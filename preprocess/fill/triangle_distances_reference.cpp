// SPDX-License-Identifier: GPL-3.0-or-later
// Distances of points from a triangle: the definition, one point at a time.
// triangle_distances_simd.cpp computes the same bits in lanes.
#include <algorithm>
#include <limits>

#include "preprocess/fill/triangle_distances.hpp"

namespace ice::reference {

void measure_distances(const TriangleSides& t, const PointBatch& points, double* out) {
    const auto dot = [](const Vec3& v, double x, double y, double z) {
        return v.x() * x + v.y() * y + v.z() * z;
    };
    for (std::size_t k = 0; k < points.count; ++k) {
        // least: of the point's heights over the three sides, negative where it is beyond one
        double least = std::numeric_limits<double>::infinity(), rim = least, height = 0.0;
        for (std::size_t e = 0; e < 3; ++e) {
            const Vec3 &from = t.corner[e], &edge = t.edge[e];
            const double x = points.x[k] - from.x(), y = points.y[k] - from.y(),
                         z = points.z[k] - from.z();
            if (e == 0) height = dot(t.normal, x, y, z);
            least = std::min(least, dot(t.inward[e], x, y, z));
            // the nearest point of the edge: its foot, or the end beyond which it lies
            const double along = dot(edge, x, y, z) * t.per_edge_sq[e];
            const double part = std::min(std::max(along, 0.0), 1.0);
            const double dx = x - part * edge.x(), dy = y - part * edge.y(),
                         dz = z - part * edge.z();
            rim = std::min(rim, dx * dx + dy * dy + dz * dz);
        }
        // inside all three edges the face is nearest, else the rim
        out[k] = least >= 0.0 ? height * height * t.per_area_sq : rim;
    }
}

}  // namespace ice::reference
