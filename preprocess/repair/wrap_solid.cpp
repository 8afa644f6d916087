// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/repair/wrap_solid.hpp"

#include "common/base/parallel.hpp"
#include "common/geometry/surface_tree.hpp"
#include "preprocess/clean/find_self_intersections.hpp"
#include "preprocess/repair/winding_solid.hpp"

namespace ice {

namespace {

// Share of the way back to the surface [-]. Not all the way: on a sharp edge vertices of both sides
// would meet in one point. Less leaves more of the offset in the volume.
constexpr double kBack = 0.9;

}  // namespace

TriangleMesh wrap_solid(const TriangleMesh& mesh, double alpha, double offset) {
    TriangleMesh wrap = alpha_wrap(mesh, alpha, offset);
    if (wrap.triangles.empty()) return wrap;
    const SurfaceTree tree(mesh);
    TriangleMesh laid = wrap;
    parallel_for(laid.vertices.size(), 100, [&](std::size_t k) {
        const Foot foot = tree.closest(laid.vertices[k]);
        // farther vertices span an opening of the mesh: there is no surface to lie on
        if (foot.distance < 2.0 * offset)
            laid.vertices[k] += kBack * (foot.point - laid.vertices[k]);
    });
    // where the surface laid back crosses itself, the wrap stays as it is: it crosses nowhere
    if (find_self_intersections(laid).empty()) wrap = std::move(laid);
    copy_regions(mesh, wrap);
    return wrap;
}

}  // namespace ice
