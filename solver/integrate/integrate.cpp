// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/integrate/integrate.hpp"

#include <algorithm>

#include "common/base/parallel.hpp"
#include "solver/water/hydrostatics.hpp"

namespace ice {

namespace {

// Below this many bodies waking threads costs more than they save.
constexpr std::size_t kSerialBodies = 512;

// Floes that a kernel takes at once: as many as the widest instruction set has lanes.
constexpr std::size_t kGroup = 8;

// Calls body(i, k) for every floe i that is not held, the k-th of them.
template <class Body>
void for_each_moving(const Bodies& b, const Body& body) {
    parallel_for(b.moving.size(), kSerialBodies,
                 [&](std::size_t k) { body(static_cast<std::size_t>(b.moving[k]), k); });
}

// Drag slows down, it never turns a motion round: in a step longer than it takes to stop, the
// force is the one that just stops. At the paper's steps this is never reached.
void limit_drag(const Bodies& b, std::size_t i, double dt, WaterLoad& drag) {
    const double stop = b.mass[i] * b.velocity[i].norm(), push = dt * drag.force.norm();
    if (push > stop) drag.force *= stop / push;
    const Mat3& r = b.rotation[i];
    const double halt = (r * (b.inertia(i) * (r.transpose() * b.angular_velocity[i]))).norm();
    const double twist = dt * drag.moment.norm();
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

void measure_loads(const Scene& scene, const Case& parameters, std::vector<FloeLoad>& out) {
    out.resize(scene.bodies.moving.size());
    for_each_moving(scene.bodies,
                    [&](std::size_t i, std::size_t k) { out[k] = load_of(scene, parameters, i); });
}

std::vector<FloeLoad> loads_by_body(const Bodies& bodies, const std::vector<FloeLoad>& loads) {
    std::vector<FloeLoad> out(bodies.size());
    for (std::size_t k = 0; k < loads.size(); ++k) out[bodies.moving[k]] = loads[k];
    return out;
}

void apply_loads(Bodies& bodies, const std::vector<FloeLoad>& loads, double dt) {
    for_each_moving(bodies, [&](std::size_t i, std::size_t k) {
        bodies.velocity[i] += dt * bodies.inverse_mass[i] * loads[k].force;
        bodies.angular_velocity[i] += dt * (bodies.inverse_inertia_world[i] * loads[k].moment);
    });
}

void advance(Scene& scene, const Advance& step) {
    Bodies& b = scene.bodies;
    b.position[kShip] += step.dt * b.velocity[kShip];
    const std::span<const std::int32_t> moving = b.moving;
    parallel_for((moving.size() + kGroup - 1) / kGroup, kSerialBodies / kGroup, [&](std::size_t g) {
        const std::size_t first = kGroup * g;
        advance_floes(b, moving.subspan(first, std::min(kGroup, moving.size() - first)), step);
    });
}

double kinetic_energy(const Bodies& bodies) {
    double energy = 0.0;
    for (const std::int32_t i : bodies.moving)
        energy += 0.5 * (bodies.momentum[i].dot(bodies.velocity[i]) +
                         bodies.angular_momentum[i].dot(bodies.angular_velocity[i]));
    return energy;
}

double potential_energy(const Scene& scene, const Case& p) {
    const Bodies& b = scene.bodies;
    double energy = 0.0;
    for (std::size_t i = 1; i < b.size(); ++i) {
        const double z = b.position[i].z();
        energy += b.mass[i] * p.gravity * z;
        if (p.buoyancy == BuoyancyModel::none) continue;
        const Shape& shape = scene.shapes[static_cast<std::size_t>(b.shape[i])];
        const Submerged wet = measure_submerged(shape, b.rotation[i], z);
        energy -= p.water_density * p.gravity * wet.volume * (z + wet.centre.z());
    }
    return energy;
}

}  // namespace ice
