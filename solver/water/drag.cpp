// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/water/drag.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ice {

namespace {

double panel_share(const Panel& panel, const Motion& motion) {
    const auto height = [&](int k) {
        return motion.rotation.row(2).dot(panel.corner[k]) + motion.height;
    };
    return wetted_share(height(0), height(1), height(2));
}

}  // namespace

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
    const double speed = motion.velocity.norm();
    if (speed == 0.0 || motion.height >= shape.bounding_radius) return out;
    const Vec3 direction = motion.rotation.transpose() * motion.velocity / speed;
    const bool below = motion.height <= -shape.bounding_radius;
    double area = 0.0;
    for (const Panel& panel : shape.panels) {
        const double facing = panel.area.dot(direction);
        if (facing > 0.0) area += facing * (below ? 1.0 : panel_share(panel, motion));
    }
    out.force = -0.5 * water_density * coefficient * area * speed * motion.velocity;
    return out;
}

WaterLoad panel_drag(const Shape& shape, const Motion& motion, double coefficient,
                     double water_density) {
    WaterLoad out;
    if (motion.height >= shape.bounding_radius) return out;
    // in body axes: panels stay, the two velocities turn
    const Vec3 v = motion.rotation.transpose() * motion.velocity;
    const Vec3 w = motion.rotation.transpose() * motion.angular_velocity;
    if (v.isZero(0.0) && w.isZero(0.0)) return out;
    const bool below = motion.height <= -shape.bounding_radius;
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
    for (const Panel& panel : shape.panels) {
        const Vec3 u = v + w.cross(panel.center);
        const double facing = panel.area.dot(u);  // projected area times |u|
        if (facing <= 0.0) continue;
        const Vec3 part = facing * (below ? 1.0 : panel_share(panel, motion)) * u;
        force += part;
        moment += panel.center.cross(part);
    }
    const double factor = -0.5 * water_density * coefficient;
    out.force = factor * (motion.rotation * force);
    out.moment = factor * (motion.rotation * moment);
    return out;
}

}  // namespace ice
