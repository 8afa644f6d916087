// SPDX-License-Identifier: GPL-3.0-or-later
/// Solids that are hard to fill: reflex edges, holes, any angle, shells that overlap.
#pragma once

#include <numbers>
#include <random>

#include "preprocess/slice/slice_solid.hpp"

namespace ice::test {

/// A prism along y over an outline in x, z, counter-clockwise seen from -y: whole numbers as
/// corners make rows run along its edges and through its corners.
inline TriangleMesh make_prism(const std::vector<std::array<double, 2>>& outline, double half) {
    Section section;
    section.loops.emplace_back();
    for (std::size_t k = 0; k < outline.size(); ++k) {
        const auto& p = outline[k];
        const auto& q = outline[(k + 1) % outline.size()];
        const Vec3 a(p[0], 0, p[1]), b(q[0], 0, q[1]);
        const Vec3 d = (b - a).normalized();
        section.loops[0].push_back({a, b, Vec3(d.z(), 0, -d.x()), 0});
    }
    TriangleMesh mesh = extrude(section, {"hull"});
    const double low = mesh.vertices[0].y();
    for (Vec3& v : mesh.vertices) v.y() *= half / std::abs(low);
    return mesh;
}

inline TriangleMesh make_l_prism() {
    return make_prism({{-2, -2}, {2, -2}, {2, 0}, {0, 0}, {0, 2}, {-2, 2}}, 1.0);
}

/// A ring around z: a solid with a hole.
inline TriangleMesh make_torus(double major, double minor, int around, int across) {
    TriangleMesh mesh;
    for (int i = 0; i < around; ++i)
        for (int j = 0; j < across; ++j) {
            const double a = 2 * std::numbers::pi * i / around,
                         b = 2 * std::numbers::pi * j / across;
            const double r = major + minor * std::cos(b);
            mesh.vertices.emplace_back(r * std::cos(a), r * std::sin(a), minor * std::sin(b));
        }
    const auto at = [&](int i, int j) { return i % around * across + j % across; };
    for (int i = 0; i < around; ++i)
        for (int j = 0; j < across; ++j) {
            mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    mesh.region.assign(mesh.triangles.size(), 0);
    return mesh;
}

inline TriangleMesh turned(TriangleMesh mesh, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    const Eigen::Quaterniond q(normal(random), normal(random), normal(random), normal(random));
    for (Vec3& v : mesh.vertices) v = q.normalized() * v;
    return mesh;
}

inline TriangleMesh joined(TriangleMesh one, const TriangleMesh& other) {
    const auto count = static_cast<std::int32_t>(one.vertices.size());
    one.vertices.insert(one.vertices.end(), other.vertices.begin(), other.vertices.end());
    for (const auto& t : other.triangles)
        one.triangles.push_back({t[0] + count, t[1] + count, t[2] + count});
    one.region.assign(one.triangles.size(), 0);
    return one;
}

}  // namespace ice::test
