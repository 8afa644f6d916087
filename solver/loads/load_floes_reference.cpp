// SPDX-License-Identifier: GPL-3.0-or-later
// Weight, buoyancy, drag and pressure of a floe, section 6: the definition, and the place where a
// load is added. load_floes_simd.cpp computes the same bits for floes of one form in lanes.
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

double length(const Vec3& v) { return std::sqrt(ordered_dot(v, v)); }

// Drag slows down, it never turns a motion through the water round: in a step longer than it takes
// to stop, the force is the one that just stops, m `fastest` / dt. The moment is limited likewise,
// by I w and by that force at the rim, for drag also turns a floe that does not turn yet.
// @return what is left of the force, as a share
double limit_drag(const Bodies& b, std::size_t i, double radius, double fastest, double dt,
                  WaterLoad& drag) {
    const double stop = b.mass[i] * fastest, push = dt * length(drag.force);
    const double left = push > stop ? stop / push : 1.0;
    drag.force *= left;
    const double turning =
        length(ordered_turned(b.rotation[i], b.inertia(i), b.angular_velocity[i])) + radius * stop;
    const double twist = dt * length(drag.moment);
    if (twist > turning) drag.moment *= turning / twist;
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
    limit_drag(b, i, shape.bounding_radius, length(u), p.time_step, drag);
    return drag;
}

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
        drag.fastest = length(u);
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
    drag.loss *= limit_drag(b, i, shape.bounding_radius, drag.fastest, p.time_step, drag);
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
