// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/water/drag.hpp"

#include <utility>

#include "solver/water/wetted_sums.hpp"

namespace ice {

double wetted_share(double z0, double z1, double z2) {
    if (z0 > z1) std::swap(z0, z1);
    if (z1 > z2) std::swap(z1, z2);
    if (z0 > z1) std::swap(z0, z1);
    if (z2 <= 0.0) return 1.0;
    if (z0 >= 0.0) return 0.0;
    // one corner wet: the cut-off tip is similar to the triangle in two edges
    if (z1 >= 0.0) return z0 / (z0 - z1) * (z0 / (z0 - z2));
    // two corners wet: all but the dry tip
    return 1.0 - z2 / (z2 - z1) * (z2 / (z2 - z0));
}

WaterLoad projected_drag(const Shape& shape, const Motion& motion, double coefficient,
                         double water_density) {
    WaterLoad out;
    if (motion.velocity.isZero(0.0) || motion.height >= shape.bounding_radius) return out;
    const WaterPlane water(motion.rotation, motion.height, shape.bounding_radius);
    // A |v|: the panels' areas are not divided by the speed, so that it need not be multiplied
    const double flow =
        sum_facing(shape.panels, water, motion.rotation.transpose() * motion.velocity);
    out.force = -0.5 * water_density * coefficient * flow * motion.velocity;
    return out;
}

WaterLoad panel_drag(const Shape& shape, const Motion& motion, double coefficient,
                     double water_density) {
    WaterLoad out;
    if (motion.height >= shape.bounding_radius) return out;
    if (motion.velocity.isZero(0.0) && motion.angular_velocity.isZero(0.0)) return out;
    const WaterPlane water(motion.rotation, motion.height, shape.bounding_radius);
    // in body axes: panels stay, the two velocities turn
    const FacingSums sums =
        sum_facing(shape.panels, water, motion.rotation.transpose() * motion.velocity,
                   motion.rotation.transpose() * motion.angular_velocity);
    const double factor = -0.5 * water_density * coefficient;
    out.force = factor * (motion.rotation * sums.force);
    out.moment = factor * (motion.rotation * sums.moment);
    return out;
}

}  // namespace ice
