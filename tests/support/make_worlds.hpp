// SPDX-License-Identifier: GPL-3.0-or-later
/// Small worlds made in code.
#pragma once

#include <random>

#include "solver/scene/build_scene.hpp"
#include "solver/step/step.hpp"
#include "tests/support/make_sphere_sets.hpp"

namespace ice {

/// A floe at rest, for tests that add many.
inline std::size_t add_floe(Scene& scene, std::int32_t shape, double density, const Vec3& position,
                            const Quaternion& orientation, std::int32_t group, bool held) {
    FloeStart start{.position = position, .orientation = orientation};
    start.hold = held ? Hold::always : Hold::never;
    return add_floe(scene, shape, density, start, group);
}

}  // namespace ice

namespace ice::test {

inline const Vec3 kPaperFloe(1.0, 0.8, 0.3);  ///< sides of the paper's floe [m]

/// No water, no gravity, one group of free floes: only contacts act.
inline Case empty_space(double dt) {
    Case p;
    p.time_step = dt;
    p.duration = 1e6;
    p.gravity = 0.0;
    p.buoyancy = BuoyancyModel::none;
    p.drag = DragModel::none;
    p.speed_table = {{0.0, 0.0}};
    p.floes.resize(1);
    p.floes[0].hold = Hold::never;
    p.contact.iterations = 1000;
    p.contact.tolerance = 1e-12;
    return p;
}

/// A world whose hull is a plate `size` with its lower face at height z; add floes to it.
inline World plate_world(const Case& parameters, const Vec3& size, double radius, double spacing,
                         double lower_face_z) {
    World w;
    w.parameters = parameters;
    w.scene = make_scene(build_shape(make_box_set(size, radius, spacing), false),
                         Vec3(0, 0, lower_face_z + 0.5 * size.z()),
                         Vec3(parameters.ship_speed(0.0), 0, 0));
    return w;
}

/// Adds floes' shape; returns its row.
inline std::int32_t add_shape(World& w, const SphereSet& set) {
    w.scene.shapes.push_back(build_shape(set, true));
    return static_cast<std::int32_t>(w.scene.shapes.size()) - 1;
}

/// Floes of `size` m at random poses around a hull of 4 times that and up to `far` sizes ahead and
/// astern of its middle; a third of them held.
inline World scattered_world(unsigned seed, int floes, double size = 1.0, double far = 3.0) {
    const Case p = empty_space(0.01);
    World w = plate_world(p, size * Vec3(4, 2, 0.6), 0.1 * size, 0.15 * size, -0.3 * size);
    const auto box = add_shape(w, make_box_set(size * Vec3(1, 0.8, 0.3), 0.05 * size, 0.1 * size));
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (int k = 0; k < floes; ++k) {
        const Vec3 at = size * Vec3(far * unit(random), 2.0 * unit(random), 1.0 * unit(random));
        const Quaternion q(unit(random), unit(random), unit(random), unit(random));
        add_floe(w.scene, box, 900.0, at, q.normalized(), 0, k % 3 == 0);
    }
    return w;
}

/// Normal and tangential force of the ship's contacts on the floes in the last step [N].
inline std::pair<Vec3, Vec3> ship_on_ice(const World& w) {
    Vec3 normal = Vec3::Zero(), tangent = Vec3::Zero();
    for (const Constraint& c : w.constraints)
        if (c.a == 0) {
            normal += c.total_normal() / w.parameters.time_step * c.normal;
            tangent += c.total_tangent() / w.parameters.time_step;
        }
    return {normal, tangent};
}

}  // namespace ice::test
