// SPDX-License-Identifier: GPL-3.0-or-later
/// Sphere sets as spherize makes them, of solids made in code.
#pragma once

#include <vector>

#include "preprocess/fill/fill_spheres.hpp"
#include "solver/scene/bodies.hpp"
#include "tests/support/make_meshes.hpp"

namespace ice::test {

/// The surface layer of a closed mesh.
inline SphereSet fill_surface(const TriangleMesh& mesh, double radius, double spacing) {
    SpheresReport report;
    FillOptions options;
    options.radius = radius;
    options.spacing = spacing;
    options.surface_only = true;
    return fill_spheres(mesh, options, report);
}

/// The surface layer of a box centred at the origin, its axes turned by `turn`.
inline SphereSet fill_box(const Vec3& size, double radius, double spacing,
                          const Quaternion& turn = Quaternion::Identity()) {
    TriangleMesh mesh = make_box_mesh(size);
    for (Vec3& v : mesh.vertices) v = turn * v;
    return fill_surface(mesh, radius, spacing);
}

/// The discs of a section: corners anticlockwise in x-z seen from port, in y = 0.
inline SphereSet fill_section(const std::vector<Vec3>& corners, double radius, double spacing) {
    Section section{{{}}};
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const Vec3 &a = corners[k], &b = corners[(k + 1) % corners.size()];
        const Vec3 d = (b - a).normalized();
        section.loops[0].push_back({a, b, Vec3(d.z(), 0.0, -d.x()), 0});
    }
    SpheresReport report;
    FillOptions options;
    options.radius = radius;
    options.spacing = spacing;
    options.surface_only = true;
    return fill_discs(section, {"hull"}, options, report);
}

}  // namespace ice::test
