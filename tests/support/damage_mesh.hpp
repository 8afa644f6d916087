// SPDX-License-Identifier: GPL-3.0-or-later
/// Damaged copies of closed meshes, as files arrive from other programs.
#pragma once

#include <algorithm>
#include <random>

#include "common/geometry/triangle_mesh.hpp"

namespace ice::test {

/// What is done to a mesh; a random choice of it per seed.
struct Damage {
    bool remove = false;     ///< up to 2 % of the faces, one at least
    bool turn = false;       ///< half of the faces, at random
    bool jitter = false;     ///< vertices by up to 1e-6 of the diagonal along each axis
    bool duplicate = false;  ///< a tenth of the faces twice
    bool split = false;      ///< four parts with vertices of their own, 3e-6 of the diagonal apart
    bool unweld = false;     ///< every face with corners of its own
};

inline Damage choose_damage(std::mt19937& random) {
    std::bernoulli_distribution coin(0.5);
    Damage d;
    for (bool* what : {&d.remove, &d.turn, &d.jitter, &d.duplicate, &d.split, &d.unweld})
        *what = coin(random);
    return d;
}

/// Vertices of its own for each class of faces, moved by up to `crack` along each axis.
template <class ClassOf>
void split_faces(TriangleMesh& mesh, const ClassOf& class_of, double crack, std::mt19937& random) {
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    std::vector<Vec3> vertices;
    std::vector<std::vector<std::pair<std::int32_t, std::int32_t>>> copies(mesh.vertices.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (std::int32_t& v : mesh.triangles[t]) {
            auto& list = copies[static_cast<std::size_t>(v)];
            const std::int32_t of_class = class_of(t);
            const auto at = std::find_if(list.begin(), list.end(),
                                         [&](const auto& c) { return c.first == of_class; });
            if (at != list.end()) {
                v = at->second;
                continue;
            }
            const auto fresh = static_cast<std::int32_t>(vertices.size());
            vertices.push_back(mesh.vertices[static_cast<std::size_t>(v)] +
                               crack * Vec3(unit(random), unit(random), unit(random)));
            list.emplace_back(of_class, fresh);
            v = fresh;
        }
    mesh.vertices = std::move(vertices);
}

inline TriangleMesh damage_mesh(TriangleMesh mesh, const Damage& damage, std::mt19937& random) {
    Eigen::AlignedBox3d box;
    for (const Vec3& v : mesh.vertices) box.extend(v);
    const double size = box.diagonal().norm();
    const auto at = [&](std::size_t count) {
        return std::uniform_int_distribution<std::size_t>(0, count - 1)(random);
    };
    if (damage.jitter) {
        std::uniform_real_distribution<double> unit(-1e-6, 1e-6);
        for (Vec3& v : mesh.vertices) v += size * Vec3(unit(random), unit(random), unit(random));
    }
    if (damage.remove) {
        const std::size_t most = std::max<std::size_t>(1, mesh.triangles.size() / 50);
        for (std::size_t count = 1 + at(most); count > 0; --count) {
            const auto t = static_cast<std::ptrdiff_t>(at(mesh.triangles.size()));
            mesh.triangles.erase(mesh.triangles.begin() + t);
            mesh.region.erase(mesh.region.begin() + t);
        }
    }
    if (damage.duplicate)
        for (std::size_t count = 1 + mesh.triangles.size() / 10; count > 0; --count) {
            const std::size_t t = at(mesh.triangles.size());
            mesh.triangles.push_back(std::array(mesh.triangles[t]));
            mesh.region.push_back(std::int32_t(mesh.region[t]));
        }
    if (damage.turn)
        for (auto& t : mesh.triangles)
            if (at(2) == 0) std::swap(t[1], t[2]);
    if (damage.split) {
        const Vec3 middle = box.center();
        split_faces(
            mesh,
            [&, centers = mesh](std::size_t t) {
                const Vec3 c = centers.corner(t, 0) + centers.corner(t, 1) + centers.corner(t, 2);
                return (c.x() > 3 * middle.x() ? 1 : 0) + (c.z() > 3 * middle.z() ? 2 : 0);
            },
            3e-6 * size, random);
    }
    if (damage.unweld)
        split_faces(
            mesh, [](std::size_t t) { return static_cast<std::int32_t>(t); }, 0.0, random);
    return mesh;
}

/// The first part of a file that was cut off: the given share of its faces.
inline TriangleMesh truncate_mesh(TriangleMesh mesh, double share) {
    const auto count = static_cast<std::size_t>(share * static_cast<double>(mesh.triangles.size()));
    mesh.triangles.resize(count);
    mesh.region.resize(count);
    return mesh;
}

/// An opening: all faces whose middle lies within a distance of a random vertex.
inline TriangleMesh tear_mesh(TriangleMesh mesh, double of_diagonal, std::mt19937& random) {
    Eigen::AlignedBox3d box;
    for (const Vec3& v : mesh.vertices) box.extend(v);
    const Vec3 at = mesh.vertices[random() % mesh.vertices.size()];
    std::size_t kept = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Vec3 middle = (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0;
        if ((middle - at).norm() < of_diagonal * box.diagonal().norm()) continue;
        mesh.triangles[kept] = mesh.triangles[t];
        mesh.region[kept++] = mesh.region[t];
    }
    mesh.triangles.resize(kept);
    mesh.region.resize(kept);
    return mesh;
}

/// Leaves out each face with the given chance.
inline TriangleMesh thin_mesh(TriangleMesh mesh, double chance, std::mt19937& random) {
    std::bernoulli_distribution drop(chance);
    std::size_t kept = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (drop(random)) continue;
        mesh.triangles[kept] = mesh.triangles[t];
        mesh.region[kept++] = mesh.region[t];
    }
    mesh.triangles.resize(kept);
    mesh.region.resize(kept);
    return mesh;
}

}  // namespace ice::test
