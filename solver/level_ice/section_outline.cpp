// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/level_ice/section_outline.hpp"

#include <utility>
#include <vector>

#include "solver/bending/convex_corners.hpp"

namespace ice {

Loop section_outline(const TriangleMesh& mesh, double z) {
    std::vector<Vec2> points;
    for (const auto& triangle : mesh.triangles)
        for (int k = 0; k < 3; ++k) {
            const Vec3& a = mesh.vertices[static_cast<std::size_t>(triangle[k])];
            const Vec3& b = mesh.vertices[static_cast<std::size_t>(triangle[(k + 1) % 3])];
            // Each edge that crosses the height gives a point; the outline is their convex hull. A
            // vertex at the height itself counts as above, so nothing is divided by 0.
            if ((a.z() < z) == (b.z() < z)) continue;
            const double share = (z - a.z()) / (b.z() - a.z());
            points.emplace_back(a.x() + share * (b.x() - a.x()), a.y() + share * (b.y() - a.y()));
        }
    return convex_corners(std::move(points));
}

}  // namespace ice
