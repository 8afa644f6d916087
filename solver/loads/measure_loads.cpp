// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/loads/measure_loads.hpp"

#include "common/base/assert.hpp"
#include "solver/loads/water_inertia.hpp"
#include "solver/scene/moving_floes.hpp"

namespace ice {

void measure_loads(const Scene& scene, const Case& parameters, std::vector<FloeLoad>& out) {
    out.resize(scene.bodies.moving.size());
    for_each_group(scene.bodies, [&](std::span<const std::int32_t> floes, std::size_t first) {
        const auto loads = std::span(out).subspan(first, floes.size());
        // Floes of one shape at a time: the kernel takes eight floes against the same facets. Added
        // mass comes after it, because it needs the force of the flow's pressure.
        load_floes(scene, parameters, floes, loads);
        if (scene.bodies.have_added_mass()) add_water_inertia(scene, parameters, floes, loads);
    });
}

void add_applied(const Bodies& bodies, const std::vector<WaterLoad>& applied,
                 std::vector<FloeLoad>& loads) {
    ICE_ASSERT(loads.size() == bodies.moving.size());
    if (applied.empty()) return;
    ICE_ASSERT(applied.size() == bodies.size());
    for_each_moving(bodies, [&](std::size_t i, std::size_t k) {
        const WaterLoad& own = applied[i];
        loads[k].applied = own;
        // A load of 0 is left out, so that a program without loads has the bits of a run: -0 + 0 is
        // 0.
        if (own.force.isZero(0.0) && own.moment.isZero(0.0)) return;
        loads[k].force += own.force;
        loads[k].moment += own.moment;
    });
}

std::vector<FloeLoad> loads_by_body(const Bodies& bodies, const std::vector<FloeLoad>& loads) {
    ICE_ASSERT(loads.size() == bodies.moving.size());
    std::vector<FloeLoad> out(bodies.size());
    for (std::size_t k = 0; k < loads.size(); ++k) out[bodies.moving[k]] = loads[k];
    return out;
}

void apply_loads(Bodies& bodies, const std::vector<FloeLoad>& loads, double dt) {
    ICE_ASSERT(loads.size() == bodies.moving.size());
    for_each_moving(bodies, [&](std::size_t i, std::size_t k) {
        // stage 6: v'' = v' + dt F / m, with added mass (m + A)^-1 instead of 1 / m
        // Held floes are not among the moving ones: they keep their velocity, that of the drifting
        // ice.
        bodies.velocity[i] += dt * bodies.inverse_mass[i] * loads[k].force;
        if (bodies.have_added_mass())
            bodies.velocity[i] += dt * (bodies.inverse_mass_excess[i] * loads[k].force);
        bodies.angular_velocity[i] += dt * (bodies.inverse_inertia_world[i] * loads[k].moment);
    });
}

}  // namespace ice
