// SPDX-License-Identifier: GPL-3.0-or-later
// icesolve as a library: a pram goes into two floes, and the force on it is printed.
#include <cstdio>

#include "preprocess/fill/fill_spheres.hpp"
#include "solver/run/make_world.hpp"

namespace {

// A box whose lower face is `taper` times as long: closed, outward, centred at the origin.
ice::TriangleMesh tapered_box(double length, double breadth, double height, double taper) {
    ice::TriangleMesh mesh;
    for (const double z : {-0.5 * height, 0.5 * height})
        for (const double y : {-0.5 * breadth, 0.5 * breadth})
            for (const double x : {-0.5 * length, 0.5 * length})
                mesh.vertices.emplace_back(z < 0.0 ? taper * x : x, y, z);
    mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    mesh.region.assign(mesh.triangles.size(), 0);
    return mesh;
}

}  // namespace

int main() {
    const ice::FillOptions fill{.radius = 0.1, .spacing = 0.2};
    ice::SpheresReport certificate;  // counts, volume, gap to the surface
    const auto hull = ice::fill_spheres(tapered_box(6.0, 2.0, 1.5, 0.6), fill, certificate);
    const auto floe = ice::fill_spheres(tapered_box(1.0, 0.8, 0.3, 1.0), fill, certificate);

    ice::Case parameters;  // the defaults of a case file
    parameters.time_step = 0.01;
    parameters.speed_table = {{0.0, 0.5}};  // [s], [m/s]
    ice::World world = ice::make_world(parameters, hull);
    const auto shape = ice::add_floe_shape(world, floe);
    const auto first = ice::add_floe(world, shape, {.position = {3.2, 0.0, -0.12}});
    ice::add_floe(world, shape, {.position = {4.4, 0.1, -0.12}});

    while (world.time < 4.0) {
        ice::step(world);
        if (world.steps % 50 != 0) continue;
        const ice::StepRecord now = ice::measure_step(world);
        const ice::Vec3 force = now.contact_force + now.friction_force;  // of the ice on the ship
        const ice::Vec3 place = world.scene.bodies.position[first];
        std::printf(
            "t = %.1f s: f_x = %7.1f N, f_z = %7.1f N; first floe at x = %.2f, z = %.2f m\n",
            world.time, force.x(), force.z(), place.x(), place.z());
    }
}
