// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/scene/set_added_mass.hpp"

#include <Eigen/Dense>
#include <cmath>

#include "common/base/assert.hpp"
#include "common/geometry/mass_properties.hpp"
#include "common/math/ordered_products.hpp"

namespace ice {

namespace {

// Panels of a shape [-]: halved edges, four times as many, change the boxes of
// tests/flow/added_mass_test.cpp by less than 2 %. The time grows with the square.
constexpr double kPanels = 400.0;

// No impulse moves ice that is held for good: added mass would have no effect.
bool stays(const Case& p, const Bodies& b, std::size_t i) {
    return p.floes[static_cast<std::size_t>(b.group[i])].hold == Hold::always;
}

}  // namespace

Mat6 added_mass_of_shape(const TriangleMesh& mesh, double water_density) {
    // triangles of edge a have some a^2 / 3, splitting longest edges leaves two thirds of a
    const double edge = std::sqrt(5.0 * measure_mass(mesh).area / kPanels);
    return added_mass(whole_body(mesh, edge, kDeep), Vec3::Zero(), water_density);
}

void add_water(Scene& scene, std::size_t body, double water_density) {
    Bodies& b = scene.bodies;
    const double mass = b.mass[body];
    const Mat6 of_water = added_mass_of_shape(
        scene.shapes[static_cast<std::size_t>(b.shape[body])].mesh, water_density);
    Inertia& inertia = b.inertias[static_cast<std::size_t>(b.inertia_row[body])];
    inertia.added = of_water.topLeftCorner<3, 3>();
    // (m + A)^-1 - 1 / m: the response to an impulse beyond 1 / m, (P2)
    inertia.inverse_excess =
        (mass * Mat3::Identity() + inertia.added).inverse() - Mat3::Identity() / mass;
    inertia.body += of_water.bottomRightCorner<3, 3>();
    inertia.inverse = inertia.body.inverse();
}

void set_added_mass(Scene& scene, const Case& parameters) {
    ICE_ASSERT(scene.dimension == 3);
    Bodies& b = scene.bodies;
    std::vector<Vec3> velocity = b.velocity, spin = b.angular_velocity;
    std::vector<bool> done(b.inertias.size(), false);
    for (std::size_t i = kShip + 1; i < b.size(); ++i) {
        const auto row = static_cast<std::size_t>(b.inertia_row[i]);
        // once for each shape and density; ice that never moves needs none
        if (done[row] || stays(parameters, b, i)) continue;
        done[row] = true;
        add_water(scene, i, parameters.water_density);
    }
    b.inverse_mass_excess.assign(b.size(), Mat3::Zero());
    // velocities as the case gives them: the momenta have the water's part as well
    for (std::size_t i = kShip + 1; i < b.size(); ++i) {
        const Mat3& r = b.rotation[i];
        b.momentum[i] =
            b.mass[i] * velocity[i] + ordered_turned(r, b.inertia_row_of(i).added, velocity[i]);
        b.angular_momentum[i] = ordered_turned(r, b.inertia(i), spin[i]);
        update_derived(b, i);
    }
}

}  // namespace ice
