// SPDX-License-Identifier: GPL-3.0-or-later
/// Prisms and frusta made in code.
#pragma once

#include <cmath>
#include <numbers>

#include "tests/support/dice.hpp"
#include "tests/support/make_meshes.hpp"

namespace ice::test {

/// The closed mesh between two rings of corners, anticlockwise seen from above; the rings' planes
/// are filled by fans, so each of them must be convex.
inline TriangleMesh make_ring_mesh(const std::vector<Vec3>& low, const std::vector<Vec3>& high) {
    TriangleMesh mesh;
    mesh.vertices = low;
    mesh.vertices.insert(mesh.vertices.end(), high.begin(), high.end());
    const auto n = static_cast<std::int32_t>(low.size());
    for (std::int32_t k = 0; k < n; ++k) {
        const std::int32_t next = (k + 1) % n;
        mesh.triangles.push_back({k, next, n + next});
        mesh.triangles.push_back({k, n + next, n + k});
        if (k == 0 || next == 0) continue;
        mesh.triangles.push_back({0, next, k});
        mesh.triangles.push_back({n, n + k, n + next});
    }
    mesh.region.assign(mesh.triangles.size(), 0);
    return mesh;
}

/// A frustum over a polygon of `sides` corners, taper from 0.3 to 1, sheared and turned at random:
/// a convex polyhedron of about 1 m of which no two edges but those of one face are parallel.
inline TriangleMesh make_random_frustum(Dice& dice, int sides) {
    const double taper = 0.65 + 0.35 * dice.number(), height = 0.6 + 0.3 * dice.number();
    std::vector<Vec3> low, high;
    for (int k = 0; k < sides; ++k) {
        const double angle = 2.0 * std::numbers::pi * (k + 0.3 * dice.number()) / sides;
        low.emplace_back(std::cos(angle), std::sin(angle), -height);
        high.emplace_back(taper * low.back().x(), taper * low.back().y(), height);
    }
    TriangleMesh mesh = make_ring_mesh(low, high);
    Mat3 shear = Mat3::Identity();
    for (int k = 0; k < 9; ++k) shear(k / 3, k % 3) += 0.25 * dice.number();
    for (Vec3& v : mesh.vertices) v = shear * v;
    return mesh;
}

}  // namespace ice::test
