// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "solver/integrate/load_floes.hpp"
#include "solver/shape/ordered_products.hpp"
#include "solver/water/hydrostatics.hpp"

namespace ice::reference {

namespace {

double length(const Vec3& v) { return std::sqrt(ordered_dot(v, v)); }

// Drag slows down, it never turns a motion round: in a step longer than it takes to stop, the
// force is the one that just stops. At the paper's steps this is never reached.
void limit_drag(const Bodies& b, std::size_t i, double dt, WaterLoad& drag) {
    const double stop = b.mass[i] * length(b.velocity[i]), push = dt * length(drag.force);
    if (push > stop) drag.force *= stop / push;
    const double halt = length(ordered_turned(b.rotation[i], b.inertia(i), b.angular_velocity[i]));
    const double twist = dt * length(drag.moment);
    if (twist > halt) drag.moment *= halt / twist;
}

// In 2D the plane's other components are rounding only; they must not add up over a run.
void keep_in_plane(WaterLoad& load) { load.force.y() = load.moment.x() = load.moment.z() = 0.0; }

FloeLoad load_of(const Scene& scene, const Case& p, std::size_t i) {
    const Bodies& b = scene.bodies;
    const Shape& shape = scene.shapes[static_cast<std::size_t>(b.shape[i])];
    const Motion motion{b.rotation[i], b.position[i].z(), b.velocity[i], b.angular_velocity[i]};
    FloeLoad load;
    if (p.drag == DragModel::projected)
        load.drag = projected_drag(shape, motion, p.drag_coefficient, p.water_density);
    if (p.drag == DragModel::panel)
        load.drag = panel_drag(shape, motion, p.drag_coefficient, p.water_density);
    limit_drag(b, i, p.time_step, load.drag);
    load.force = load.drag.force;
    load.moment = load.drag.moment;
    load.force.z() -= b.mass[i] * p.gravity;
    if (p.buoyancy != BuoyancyModel::none) {
        const Submerged wet = measure_submerged(shape, b.rotation[i], b.position[i].z());
        const Vec3 lift(0.0, 0.0, p.water_density * p.gravity * wet.volume);
        load.force += lift;
        load.righting = wet.centre.cross(lift);
        if (p.buoyancy == BuoyancyModel::distributed) load.moment += load.righting;
    }
    if (scene.dimension == 2) {
        keep_in_plane(load);
        keep_in_plane(load.drag);
    }
    return load;
}

}  // namespace

void load_floes(const Scene& scene, const Case& parameters, std::span<const std::int32_t> floes,
                std::span<FloeLoad> out) {
    for (std::size_t k = 0; k < floes.size(); ++k)
        out[k] = load_of(scene, parameters, static_cast<std::size_t>(floes[k]));
}

}  // namespace ice::reference
