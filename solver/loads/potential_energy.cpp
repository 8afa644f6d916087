// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/loads/potential_energy.hpp"

#include "solver/water/hydrostatics.hpp"

namespace ice {

double potential_energy(const Scene& scene, const Case& p) {
    const Bodies& b = scene.bodies;
    double energy = 0.0;
    for (std::size_t i = 1; i < b.size(); ++i) {
        const double z = b.position[i].z();
        energy += b.mass[i] * p.gravity * z;
        if (p.buoyancy == BuoyancyModel::none) continue;
        const Shape& shape = scene.shapes[static_cast<std::size_t>(b.shape[i])];
        const Submerged wet = measure_submerged(shape, b.rotation[i], z);
        // The displaced water has left the depth of the centre of buoyancy: its potential
        // energy is gained when the floe rises.
        energy -= p.water_density * p.gravity * wet.volume * (z + wet.centre.z());
    }
    return energy;
}

}  // namespace ice
