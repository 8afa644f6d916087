// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/way_out.hpp"

#include <tuple>

#include "solver/narrow/nearest_sphere.hpp"

namespace ice {

WayOut way_out(const Scene& scene, std::int32_t body, const Vec3& point, const Foot& foot) {
    const Shape& shape = scene.shapes[static_cast<std::size_t>(scene.bodies.shape[body])];
    WayOut out{nearest_sphere(shape, foot.point), foot.distance,
               (foot.point - point) / foot.distance, foot.point};
    if (scene.crushed.is_whole(body)) return out;
    out.depth -= scene.crushed.depth_of(body, out.sphere, out.outward);
    const double reach = shape.patch_radius * shape.patch_radius;
    for (std::int32_t k = 0; k < std::ssize(shape.center); ++k) {
        const Vec3 moved = scene.crushed.displacement_of(body, k);
        const double length = moved.norm();
        if (length == 0.0) continue;
        const Vec3 inwards = moved / length;
        // depth below the sphere's foremost point, where its face was before it was crushed
        const Vec3 from = point - shape.center[k];
        const double behind = from.dot(inwards), along = behind + shape.radius[k];
        // beside the path the ice is another sphere's
        if (along < 0.0 || (from - behind * inwards).squaredNorm() > reach) continue;
        const double depth = along - length;
        // of equals the first in mirror rank, as in nearest_sphere()
        if (std::tie(depth, shape.mirror_rank[k]) <
            std::tie(out.depth, shape.mirror_rank[out.sphere]))
            out = {k, depth, -inwards, point - depth * inwards};
    }
    return out;
}

}  // namespace ice
