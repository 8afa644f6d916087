// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/measure/mirror_symmetry.hpp"

#include <atomic>

#include "common/base/parallel.hpp"

namespace ice {

bool is_mirror_symmetric(const SurfaceTree& tree) {
    const TriangleMesh& mesh = tree.mesh();
    Eigen::AlignedBox3d box;
    for (const Vec3& v : mesh.vertices) box.extend(v);
    // Coordinates in single precision are off by 6e-8 of the size.
    const double tolerance = 1e-7 * box.diagonal().norm();
    std::atomic<bool> symmetric{true};
    const auto check = [&](const Vec3& p) {
        // once one image is off the others do not matter
        if (!symmetric) return;
        if (tree.is_clear(Vec3(p.x(), -p.y(), p.z()), tolerance)) symmetric = false;
    };
    // Corners and middles of triangles whose images lie on the surface: planes and open edges
    // then agree, however both sides are triangulated.
    parallel_for(mesh.vertices.size(), 512, [&](std::size_t k) { check(mesh.vertices[k]); });
    parallel_for(mesh.triangles.size(), 512, [&](std::size_t t) {
        check((mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0);
    });
    return symmetric;
}

}  // namespace ice
