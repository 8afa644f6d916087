// SPDX-License-Identifier: GPL-3.0-or-later
/// Sphere sets made in code, so that solver tests do not depend on spherize.
#pragma once

#include <cmath>

#include "common/formats/sphere_set.hpp"

namespace ice::test {

/// A closed box mesh centred at the origin, region "hull".
inline TriangleMesh make_box_mesh(const Vec3& size) {
    TriangleMesh mesh;
    for (int k = 0; k < 8; ++k)
        mesh.vertices.push_back(
            0.5 * size.cwiseProduct(Vec3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1)));
    mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    mesh.region.assign(12, 0);
    return mesh;
}

/// Spheres of one radius on a box: centres evenly spaced by at most `spacing` on the box shrunk by
/// the radius, so that every outer sphere is tangent to the faces beside it.
/// In 2D (dimension 2) one layer of discs at y = 0; size.y() must be 1 for values per metre.
inline SphereSet make_box_set(const Vec3& size, double radius, double spacing, int dimension = 3) {
    SphereSet set;
    set.dimension = dimension;
    set.radius = radius;
    set.spacing = spacing;
    set.mode = "fill";
    set.source_mesh = "box";
    set.mesh = make_box_mesh(size);
    set.solid = measure_mass(set.mesh);

    int count[3];
    Vec3 low, pitch;
    for (int d = 0; d < 3; ++d) {
        const double span = size[d] - 2.0 * radius;
        count[d] = static_cast<int>(std::ceil(span / spacing - 1e-9)) + 1;
        low[d] = -0.5 * span;
        pitch[d] = count[d] > 1 ? span / (count[d] - 1) : 0.0;
    }
    if (dimension == 2) {
        count[1] = 1;
        low.y() = 0.0;
    }
    const double total = static_cast<double>(count[0]) * count[1] * count[2];
    // surface spheres first, then those inside
    for (int n = 0; n < 2 * count[0] * count[1] * count[2]; ++n) {
        const int pass = n / (count[0] * count[1] * count[2]);
        const int x = n % count[0], y = n / count[0] % count[1],
                  z = n / (count[0] * count[1]) % count[2];
        const int at[3] = {x, y, z};
        Vec3 normal = Vec3::Zero(), center;
        for (int d = 0; d < 3; ++d) {
            center[d] = low[d] + at[d] * pitch[d];
            if (dimension == 2 && d == 1) continue;
            normal[d] = at[d] == 0 ? -1.0 : at[d] == count[d] - 1 ? 1.0 : 0.0;
        }
        const double faces = normal.squaredNorm();
        if ((faces > 0) != (pass == 0)) continue;
        set.centers.push_back(center);
        set.radii.push_back(radius);
        set.volumes.push_back(set.solid.volume / total);
        if (pass == 1) continue;
        ++set.surface_count;
        set.normals.push_back(normal.normalized());
        for (int d = 0; d < 3 && faces > 1; ++d)
            if (normal[d] != 0.0)
                set.creases.push_back(
                    {static_cast<std::int32_t>(set.surface_count - 1), normal[d] * Vec3::Unit(d)});
        set.normal_spread.push_back(faces > 1 ? std::acos(1.0 / std::sqrt(faces)) : 0.0);
        // enough for tests: a face sphere stands for its cell of the face
        set.areas.push_back(faces * pitch.x() * (dimension == 2 ? 1.0 : pitch.y()));
        set.regions.push_back(0);
    }
    return set;
}

/// One sphere of density-1 mass properties, with the mass and inertia of the cube around it.
inline SphereSet make_ball_set(double radius) {
    SphereSet set = make_box_set(Vec3::Constant(2.0 * radius), radius, 2.0 * radius);
    set.surface_count = 1;
    set.creases.clear();
    set.normals = {Vec3::UnitZ()};
    set.normal_spread = {3.14159265358979};  // all directions
    set.areas = {set.solid.area};
    set.regions = {0};
    return set;
}

}  // namespace ice::test
