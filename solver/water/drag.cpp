// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/water/drag.hpp"

#include <algorithm>
#include <utility>

#include "common/math/ordered_products.hpp"
#include "solver/water/wetted_sums.hpp"

namespace ice {

double wetted_share(double z0, double z1, double z2) {
    if (z0 > z1) std::swap(z0, z1);
    // Sorted, so that the corner that is alone on its side of the water is the first or the last.
    if (z1 > z2) std::swap(z1, z2);
    if (z0 > z1) std::swap(z0, z1);
    if (z2 <= 0.0) return 1.0;
    if (z0 > 0.0) return 0.0;
    // the tip that is cut off is similar to the triangle in two edges
    const auto tip = [](double apex, double middle, double other) {
        return apex * apex / std::max((apex - middle) * (apex - other), kFlat);
    };
    return z1 > 0.0 ? tip(z0, z1, z2) : 1.0 - tip(z2, z1, z0);
}

WaterLoad projected_drag(const Shape& shape, const Motion& motion, double coefficient,
                         double water_density) {
    WaterLoad out;
    if (motion.velocity.isZero(0.0) || motion.height >= shape.bounding_radius) return out;
    const WaterPlane water(motion.rotation, motion.height);
    // (16), A |v|: facets' areas are not divided by the speed, so that it need not be multiplied
    const double flow =
        integrate_facing(shape.facets, water, ordered_transposed(motion.rotation, motion.velocity));
    out.force = -0.5 * water_density * coefficient * flow * motion.velocity;
    return out;
}

WaterLoad panel_drag(const Shape& shape, const Motion& motion, double coefficient,
                     double water_density) {
    WaterLoad out;
    if (motion.height >= shape.bounding_radius) return out;
    if (motion.velocity.isZero(0.0) && motion.angular_velocity.isZero(0.0)) return out;
    const WaterPlane water(motion.rotation, motion.height);
    // (17) in body axes: facets stay, the two velocities turn
    const Vec3 v = ordered_transposed(motion.rotation, motion.velocity);
    const Vec3 w = ordered_transposed(motion.rotation, motion.angular_velocity);
    const FacingIntegrals met = integrate_facing(shape.facets, water, v, w);
    // with u = v + w x p: int f u, and int f p x u as p x (w x p) = (p . p) w - (p . w) p
    const Vec3 force = met.flow * v + w.cross(met.first);
    Mat3 second;
    second << met.square.x(), met.mixed.x(), met.mixed.y(),  //
        met.mixed.x(), met.square.y(), met.mixed.z(),        //
        met.mixed.y(), met.mixed.z(), met.square.z();
    const double total = (met.square[0] + met.square[1]) + met.square[2];
    const Vec3 moment = met.first.cross(v) + total * w - ordered_product(second, w);
    const double factor = -0.5 * water_density * coefficient;
    const Mat3 turn = factor * motion.rotation;
    out.force = ordered_product(turn, force);
    out.moment = ordered_product(turn, moment);
    return out;
}

}  // namespace ice
