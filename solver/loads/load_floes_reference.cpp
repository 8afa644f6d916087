// SPDX-License-Identifier: GPL-3.0-or-later
// Weight, buoyancy, drag and pressure of a floe, section 6: the definition, and the place where a
// load is added. load_floes_simd.cpp computes the same bits for floes of one shape in lanes.
#include <cmath>

#include "common/math/ordered_products.hpp"
#include "solver/loads/load_floes.hpp"
#include "solver/water/hydrostatics.hpp"
#include "solver/water/pressure_load.hpp"
#include "solver/water/relative_drag.hpp"

namespace ice {

WaterLoad flow_pressure(const Scene& scene, const Case& parameters, std::size_t floe) {
    const Bodies& b = scene.bodies;
    const Shape& shape = scene.shapes[static_cast<std::size_t>(b.shape[floe])];
    const WaterFlow& water = scene.water;
    const bool reached = water.presses && water.reaches(b.position[floe], shape.bounding_radius);
    if (!reached) return {};
    // p of (P1) where a point of the floe is, in world axes
    const auto pressure = [&](const Vec3& at) {
        return parameters.water_density *
               reference::pressure_at(water,
                                      b.position[floe] + ordered_product(b.rotation[floe], at));
    };
    WaterLoad out = pressure_load(shape, b.rotation[floe], b.position[floe].z(), pressure);
    if (scene.dimension == 2) out.force.y() = out.moment.x() = out.moment.z() = 0.0;
    return out;
}

}  // namespace ice

namespace ice::reference {

namespace {

// Drag slows down, it never turns a motion through the water round. With the impulse J = dt (F, T)
// of a step the energy of that motion changes by J M^-1 J / 2 - dt `lost`. It is least at the share
// dt lost / (J M^-1 J) of J; more than that share is left out. Of a force alone that is m u / dt.
// At the paper's steps this is never reached.
// @param lost  power of the drag, -(F . u + T . w) [W]
// @return the share of the drag that is left
double limit_drag(const Bodies& b, std::size_t i, double lost, double dt, WaterLoad& drag) {
    const double turned =
        ordered_dot(drag.moment, ordered_turned(b.rotation[i], b.inverse_inertia(i), drag.moment));
    const double gained = dt * (ordered_dot(drag.force, drag.force) / b.mass[i] + turned);
    if (!(gained > lost)) return 1.0;
    const double left = lost > 0.0 ? lost / gained : 0.0;
    drag.force *= left;
    drag.moment *= left;
    return left;
}

// In 2D the plane's other components are rounding only; they must not add up over a run.
void keep_in_plane(WaterLoad& load) { load.force.y() = load.moment.x() = load.moment.z() = 0.0; }

void add_pressure(const WaterLoad& pressure, FloeLoad& load) {
    load.pressure = pressure;
    load.force += pressure.force;
    load.moment += pressure.moment;
}

// In water at rest or in an even current: by the motion through it, so that a current and all that
// drifts with it are a world at rest.
WaterLoad drag_in_current(const Scene& scene, const Case& p, std::size_t i) {
    const Bodies& b = scene.bodies;
    const Shape& shape = scene.shapes[static_cast<std::size_t>(b.shape[i])];
    const Vec3 u = b.velocity[i] - scene.water.current;
    const Motion motion{b.rotation[i], b.position[i].z(), u, b.angular_velocity[i]};
    WaterLoad drag;
    if (p.drag == DragModel::projected)
        drag = projected_drag(shape, motion, p.drag_coefficient, p.water_density);
    if (p.drag == DragModel::panel)
        drag = panel_drag(shape, motion, p.drag_coefficient, p.water_density);
    limit_drag(b, i,
               -(ordered_dot(drag.force, u) + ordered_dot(drag.moment, b.angular_velocity[i])),
               p.time_step, drag);
    return drag;
}

// In the table around the hull: the law sees the water's velocity at every corner, or for the
// paper's law at the centre alone.
RelativeDrag drag_in_flow(const Scene& scene, const Case& p, std::size_t i) {
    const Bodies& b = scene.bodies;
    const Shape& shape = scene.shapes[static_cast<std::size_t>(b.shape[i])];
    RelativeDrag drag;
    if (p.drag == DragModel::projected) {
        // (16) for the body as a whole, with u of (24) at its centre
        const Vec3 u = b.velocity[i] - water_at(scene.water, b.position[i]);
        const Motion motion{b.rotation[i], b.position[i].z(), u, b.angular_velocity[i]};
        static_cast<WaterLoad&>(drag) =
            projected_drag(shape, motion, p.drag_coefficient, p.water_density);
        drag.loss = -ordered_dot(drag.force, u);
    }
    if (p.drag == DragModel::panel) {
        // (25), each facet by itself: u differs along the floe, given in the floe's own axes
        const auto water = [&](const Vec3& at) {
            return ordered_transposed(
                b.rotation[i],
                water_at(scene.water, b.position[i] + ordered_product(b.rotation[i], at)));
        };
        const Motion motion{b.rotation[i], b.position[i].z(), b.velocity[i], b.angular_velocity[i]};
        drag = relative_drag(shape, motion, water, p.drag_coefficient, p.water_density);
    }
    drag.loss *= limit_drag(b, i, drag.loss, p.time_step, drag);
    return drag;
}

FloeLoad load_of(const Scene& scene, const Case& p, std::size_t i) {
    const Bodies& b = scene.bodies;
    const Shape& shape = scene.shapes[static_cast<std::size_t>(b.shape[i])];
    FloeLoad load;
    if (scene.water.reaches(b.position[i], shape.bounding_radius)) {
        const RelativeDrag drag = drag_in_flow(scene, p, i);
        load.drag = drag;
        // Drag times the water's velocity: the power on the floe plus the power lost in the motion
        // relative to the water.
        load.water_power = (ordered_dot(drag.force, b.velocity[i]) +
                            ordered_dot(drag.moment, b.angular_velocity[i])) +
                           drag.loss;
    } else {
        load.drag = drag_in_current(scene, p, i);
        // a uniform current does the work force * current, whatever the floe's motion
        load.water_power = ordered_dot(load.drag.force, scene.water.current);
    }
    load.force = load.drag.force;
    load.moment = load.drag.moment;
    // weight, at the centre of mass: no moment
    load.force.z() -= b.mass[i] * p.gravity;
    if (p.buoyancy != BuoyancyModel::none) {
        const Submerged wet = measure_submerged(shape, b.rotation[i], b.position[i].z());
        // (14): rho_w g V upwards, at the centre of buoyancy relative to the centre of mass
        const Vec3 lift(0.0, 0.0, p.water_density * p.gravity * wet.volume);
        load.force += lift;
        load.righting = wet.centre.cross(lift);
        // The righting moment about the centre of mass; the model "centre" leaves it out, the
        // ledger counts the work that it would have done.
        if (p.buoyancy == BuoyancyModel::distributed) load.moment += load.righting;
    }
    if (scene.dimension == 2) {
        keep_in_plane(load);
        keep_in_plane(load.drag);
    }
    if (scene.water.presses) add_pressure(flow_pressure(scene, p, i), load);
    return load;
}

}  // namespace

void load_floes(const Scene& scene, const Case& parameters, std::span<const std::int32_t> floes,
                std::span<FloeLoad> out) {
    for (std::size_t k = 0; k < floes.size(); ++k)
        out[k] = load_of(scene, parameters, static_cast<std::size_t>(floes[k]));
}

}  // namespace ice::reference
