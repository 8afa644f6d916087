// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/water/hydrostatics.hpp"

#include <algorithm>
#include <utility>

#include "common/base/assert.hpp"
#include "common/math/ordered_products.hpp"
#include "solver/water/wetted_sums.hpp"

namespace ice {

namespace {

// Beyond every vertex [m], and finite: of a mesh without vertices the mean of both ends is a
// number.
constexpr double kBeyondVertices = 1e300;

// z-extent of the turned shape about the body origin
std::pair<double, double> vertical_extent(const Shape& shape, const Mat3& rotation) {
    double low = kBeyondVertices, high = -kBeyondVertices;
    for (const Vec3& v : shape.mesh.vertices) {
        const double z = rotation.row(2).dot(v);
        low = std::min(low, z);
        high = std::max(high, z);
    }
    return {low, high};
}

}  // namespace

Submerged measure_submerged(const Shape& shape, const Mat3& rotation, double height) {
    Submerged out;
    // a sphere about the origin decides many cases without the triangles
    if (height >= shape.bounding_radius) return out;
    const WaterPlane water(rotation, height);
    WettedIntegrals wet;
    if (height > -shape.bounding_radius) {
        wet = integrate_wetted(shape.facets, water);
        if (!wet.any_wet) return out;
    }
    // Wholly under water: the solid's own volume, so that a floe's buoyancy does not change by the
    // rounding of a sum while it turns.
    if (!wet.any_dry) {
        out.volume = shape.solid.volume;
        out.centre = ordered_product(rotation, shape.solid.centroid);
        return out;
    }
    // Rounding of a corner that just dips in: no centre can be divided from it.
    if (wet.volume <= 0.0) return out;
    // int z^2 n_z dA = 2 V z_c, and z = up . p + height; by the divergence theorem with the field
    // (0, 0, z) p, whose divergence is p + z up, int p z n_z dA = V p_c + V z_c up
    const double depth_moment = 0.5 * (ordered_dot(water.up, wet.first) + height * wet.volume);
    out.volume = wet.volume;
    const Vec3 centre = (wet.first - depth_moment * water.up) / wet.volume;
    out.centre = ordered_product(rotation, centre);
    return out;
}

double floating_height(const Shape& shape, const Mat3& rotation, double fraction) {
    ICE_ASSERT(fraction > 0.0);
    const auto [low, high] = vertical_extent(shape, rotation);
    // bisection: the wetted volume falls as the shape rises
    double wet = -high, dry = -low;  // heights of the origin: all below, all above the water
    const double target = fraction * shape.solid.volume;
    // As dense as water, or denser: the highest place at which it is wholly wet.
    if (target >= shape.solid.volume) return wet;
    while (dry - wet > 1e-12 * (high - low)) {
        const double middle = 0.5 * (wet + dry);
        if (middle == wet || middle == dry) break;
        (measure_submerged(shape, rotation, middle).volume > target ? wet : dry) = middle;
    }
    return 0.5 * (wet + dry);
}

}  // namespace ice
