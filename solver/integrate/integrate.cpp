// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/integrate/integrate.hpp"

#include "common/base/parallel.hpp"
#include "solver/integrate/rotation.hpp"
#include "solver/water/hydrostatics.hpp"

namespace ice {

namespace {

// Below this many bodies waking threads costs more than they save.
constexpr std::size_t kSerialBodies = 512;

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

void store_momenta(Bodies& bodies, const std::vector<Vec3>& angular_velocity_start) {
    for_each_moving(bodies, [&](std::size_t i, std::size_t) {
        const Mat3& r = bodies.rotation[i];
        const Vec3 change = bodies.angular_velocity[i] - angular_velocity_start[i];
        bodies.momentum[i] = bodies.mass[i] * bodies.velocity[i];
        if (!change.isZero(0.0))
            bodies.angular_momentum[i] += r * (bodies.inertia(i) * (r.transpose() * change));
    });
}

void advance_poses(Scene& scene, const Nudges& nudges, double dt) {
    Bodies& b = scene.bodies;
    b.position[kShip] += dt * b.velocity[kShip];
    for_each_moving(b, [&](std::size_t i, std::size_t) {
        b.position[i] += dt * b.velocity[i] + nudges.shift[i];
        b.orientation[i] =
            advance_orientation(b.orientation[i], b.inverse_inertia(i), b.angular_momentum[i], dt);
        if (!nudges.turn[i].isZero(0.0))
            b.orientation[i] = (exponential_map(nudges.turn[i]) * b.orientation[i]).normalized();
        update_derived(b, i);
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
