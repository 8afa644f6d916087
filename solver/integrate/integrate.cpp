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

// Calls body(floes, k) for groups of floes that are not held, the first the k-th of all.
template <class Body>
void for_each_group(const Bodies& b, const Body& body) {
    const std::span<const std::int32_t> moving = b.moving;
    parallel_for((moving.size() + kGroup - 1) / kGroup, kSerialBodies / kGroup, [&](std::size_t g) {
        const std::size_t first = kGroup * g;
        body(moving.subspan(first, std::min(kGroup, moving.size() - first)), first);
    });
}

}  // namespace

void measure_loads(const Scene& scene, const Case& parameters, std::vector<FloeLoad>& out) {
    out.resize(scene.bodies.moving.size());
    for_each_group(scene.bodies, [&](std::span<const std::int32_t> floes, std::size_t first) {
        load_floes(scene, parameters, floes, std::span(out).subspan(first, floes.size()));
    });
}

void add_applied(const Bodies& bodies, const std::vector<WaterLoad>& applied,
                 std::vector<FloeLoad>& loads) {
    if (applied.empty()) return;
    for_each_moving(bodies, [&](std::size_t i, std::size_t k) {
        const WaterLoad& own = applied[i];
        loads[k].applied = own;
        if (own.force.isZero(0.0) && own.moment.isZero(0.0)) return;
        loads[k].force += own.force;
        loads[k].moment += own.moment;
    });
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
    for_each_group(b, [&](std::span<const std::int32_t> floes, std::size_t) {
        advance_floes(b, floes, step);
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
