// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/feature/way_out.hpp"

#include <optional>
#include <tuple>

#include "solver/narrow/feature/nearest_sphere.hpp"

namespace ice {

namespace {

// Rounding of places in a solid [m]. With 0, whether a seat on the face of a crushed sphere is in
// its notch depends on the last bit; a larger value makes notches longer by as much.
constexpr double kPlaceRounding = 1e-9;

struct Notch {
    double depth;  // of a point behind the notch's bottom [m]; negative in the notch
    Vec3 outward;  // unit
};

// The notch of a sphere that has moved, seen from a point; none where the point is out of reach.
std::optional<Notch> notch_of(const Shape& shape, std::int32_t k, const Vec3& moved,
                              const Vec3& point) {
    const double length = moved.norm();
    if (length == 0.0) return std::nullopt;
    const Vec3 inwards = moved / length;
    // depth below the sphere's foremost point, where its face was before it was crushed
    const Vec3 from = point - shape.center[k];
    const double behind = from.dot(inwards), along = behind + shape.radius[k];
    // beside the path the ice is another sphere's
    const double radius_sq = shape.patch_radius * shape.patch_radius;
    if (along < -kPlaceRounding || (from - behind * inwards).squaredNorm() > radius_sq)
        return std::nullopt;
    return Notch{along - length, -inwards};
}

const Shape& shape_of(const Scene& scene, std::int32_t body) {
    return scene.shapes[static_cast<std::size_t>(scene.bodies.shape[body])];
}

}  // namespace

WayOut way_out(const Scene& scene, std::int32_t body, const Vec3& point, const Foot& foot) {
    const Shape& shape = shape_of(scene, body);
    WayOut out{nearest_sphere(shape, foot.point), foot.distance,
               (foot.point - point) / foot.distance, foot.point};
    if (scene.crushed.is_whole(body)) return out;
    out.depth -= scene.crushed.depth_of(body, out.sphere, out.outward);
    out.foot = point + out.depth * out.outward;
    for (std::int32_t k = 0; k < std::ssize(shape.center); ++k) {
        const auto notch = notch_of(shape, k, scene.crushed.displacement_of(body, k), point);
        // of equals the first in mirror rank, as in nearest_sphere()
        if (notch && std::tie(notch->depth, shape.mirror_rank[k]) <
                         std::tie(out.depth, shape.mirror_rank[out.sphere]))
            out = {k, notch->depth, notch->outward, point + notch->depth * notch->outward};
    }
    return out;
}

bool lies_in_notch(const Scene& scene, std::int32_t body, std::int32_t sphere) {
    if (scene.crushed.is_whole(body)) return false;
    if (!scene.crushed.displacement_of(body, sphere).isZero(0.0)) return false;
    const Shape& shape = shape_of(scene, body);
    const Vec3 seat = shape.center[sphere] + shape.radius[sphere] * shape.normal[sphere];
    for (std::int32_t k = 0; k < std::ssize(shape.center); ++k) {
        const auto notch = notch_of(shape, k, scene.crushed.displacement_of(body, k), seat);
        if (notch && notch->depth < 0.0) return true;
    }
    return false;
}

}  // namespace ice
