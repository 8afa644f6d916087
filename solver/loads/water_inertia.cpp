// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/loads/water_inertia.hpp"

#include "common/base/assert.hpp"
#include "common/math/ordered_products.hpp"

namespace ice {

namespace {

void add(const Scene& scene, const Case& p, std::size_t i, FloeLoad& load) {
    const Bodies& b = scene.bodies;
    // (P3), Kirchhoff's equations for a body with added mass A, in world axes. In water at rest the
    // moment is that of Munk, -v x A v.
    const Mat3 water_mass = ordered_turned(b.rotation[i], b.inertia_row_of(i).added);
    const Vec3 &v = b.velocity[i], &spin = b.angular_velocity[i];
    const auto munk = [&](const Vec3& u) { return Vec3(-u.cross(ordered_product(water_mass, u))); };
    load.moment += munk(v);
    if (!scene.water.flows() && scene.water.current.isZero(0.0)) return;
    const Vec3 w = reference::water_at(scene.water, b.position[i]);
    // In moving water v - w takes the place of v (docs/method.md, section 6): the difference to the
    // moment above, and the force of the momentum A w, which turns with the floe.
    WaterLoad moved;
    moved.moment = munk(v - w) - munk(v);
    moved.force = spin.cross(ordered_product(water_mass, w)) -
                  ordered_product(water_mass, Vec3(spin.cross(w)));
    // Accelerated water pushes the added mass as it pushes the displaced water (Taylor): the
    // pressure's acceleration is its force / (rho V).
    if (scene.water.presses) {
        const Shape& shape = scene.shapes[static_cast<std::size_t>(b.shape[i])];
        moved.force += ordered_product(water_mass, load.pressure.force) /
                       (p.water_density * shape.solid.volume);
    }
    load.pressure.force += moved.force;
    load.pressure.moment += moved.moment;
    load.force += moved.force;
    load.moment += moved.moment;
}

}  // namespace

void add_water_inertia(const Scene& scene, const Case& parameters,
                       std::span<const std::int32_t> floes, std::span<FloeLoad> loads) {
    ICE_ASSERT(scene.bodies.have_added_mass() && loads.size() == floes.size());
    for (std::size_t k = 0; k < floes.size(); ++k)
        add(scene, parameters, static_cast<std::size_t>(floes[k]), loads[k]);
}

}  // namespace ice
