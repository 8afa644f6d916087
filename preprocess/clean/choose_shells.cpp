// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/clean/choose_shells.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <numeric>

#include "preprocess/clean/edge_table.hpp"
#include "preprocess/clean/keep_triangles.hpp"

namespace ice {

namespace {

// Volume of a shell that counts as none, of its area to the power of 3/2 (a sphere has 0.094).
constexpr double kFlat = 1e-9;

struct Shell {
    std::vector<std::int32_t> triangles;
    Eigen::AlignedBox3d box;
    double volume = 0.0;  // signed
    double area = 0.0;
    Vec3 sample = Vec3::Zero();  // in a face: shells may share a corner, but no face
};

// Joins triangles across edges; returns one root per triangle.
std::vector<std::int32_t> connect(const TriangleMesh& mesh) {
    std::vector<std::int32_t> parent(mesh.triangles.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](std::int32_t t) {
        while (parent[static_cast<std::size_t>(t)] != t) {
            auto& up = parent[static_cast<std::size_t>(t)];
            up = parent[static_cast<std::size_t>(up)];
            t = up;
        }
        return t;
    };
    for (const MeshEdge& edge : edge_table(mesh)) {
        const std::int32_t a = root(edge.triangles[0]), b = root(edge.triangles[1]);
        parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    }
    for (std::size_t t = 0; t < parent.size(); ++t) parent[t] = root(static_cast<std::int32_t>(t));
    return parent;
}

std::vector<Shell> find_shells(const TriangleMesh& mesh) {
    const std::vector<std::int32_t> root = connect(mesh);
    std::vector<std::int32_t> index(root.size(), -1);
    std::vector<Shell> shells;
    for (std::size_t t = 0; t < root.size(); ++t) {
        std::int32_t& at = index[static_cast<std::size_t>(root[t])];
        if (at < 0) {
            at = static_cast<std::int32_t>(shells.size());
            shells.emplace_back();
            shells.back().sample =
                (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0;
        }
        Shell& shell = shells[static_cast<std::size_t>(at)];
        shell.triangles.push_back(static_cast<std::int32_t>(t));
        for (int k = 0; k < 3; ++k) shell.box.extend(mesh.corner(t, k));
    }
    for (Shell& shell : shells) {
        const Vec3 reference = shell.box.center();
        for (const std::int32_t t : shell.triangles) {
            const auto tt = static_cast<std::size_t>(t);
            const Vec3 a = mesh.corner(tt, 0) - reference, b = mesh.corner(tt, 1) - reference,
                       c = mesh.corner(tt, 2) - reference;
            shell.volume += a.dot(b.cross(c)) / 6.0;
            shell.area += mesh.area_vector(tt).norm();
        }
    }
    return shells;
}

// Winding number of a shell around a point not on it: the solid angles of its triangles add up
// (van Oosterom and Strackee, IEEE Trans. Biomed. Eng. 30(2), 1983).
int winding(const TriangleMesh& mesh, const Shell& shell, const Vec3& p) {
    double angle = 0.0;
    for (const std::int32_t t : shell.triangles) {
        const auto tt = static_cast<std::size_t>(t);
        const Vec3 a = mesh.corner(tt, 0) - p, b = mesh.corner(tt, 1) - p,
                   c = mesh.corner(tt, 2) - p;
        const double la = a.norm(), lb = b.norm(), lc = c.norm();
        const double below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
        angle += 2.0 * std::atan2(a.dot(b.cross(c)), below);
    }
    return static_cast<int>(std::lround(angle / (4.0 * std::numbers::pi)));
}

bool is_flat(const Shell& shell) {
    return std::abs(shell.volume) <= kFlat * std::pow(shell.area, 1.5);
}

}  // namespace

ShellCounts choose_shells(TriangleMesh& mesh, SolidKind kind) {
    const std::vector<Shell> shells = find_shells(mesh);
    ShellCounts counts;
    counts.shells = static_cast<std::int64_t>(shells.size());
    std::vector<std::uint8_t> keep(mesh.triangles.size(), 0), flip(mesh.triangles.size(), 0);
    for (const Shell& shell : shells) {
        if (is_flat(shell)) {
            ++counts.flat;
            continue;
        }
        int outside = 0;
        bool enclosed = false;
        for (const Shell& other : shells) {
            if (&other == &shell || is_flat(other) || !other.box.contains(shell.box)) continue;
            const int around = winding(mesh, other, shell.sample);
            outside += around;
            enclosed = enclosed || around != 0;
        }
        const int inside = outside + (shell.volume > 0.0 ? 1 : -1);
        const bool bounds =
            kind == SolidKind::envelope ? !enclosed : (outside != 0) != (inside != 0);
        if (!bounds) {
            ++counts.dropped;
            continue;
        }
        // the solid lies where the winding number is not zero
        const bool solid_within = kind == SolidKind::envelope || inside != 0;
        const bool wrong = solid_within != (shell.volume > 0.0);
        counts.flipped += wrong ? 1 : 0;
        for (const std::int32_t t : shell.triangles) {
            keep[static_cast<std::size_t>(t)] = 1;
            flip[static_cast<std::size_t>(t)] = wrong ? 1 : 0;
        }
    }
    for (std::size_t t = 0; t < flip.size(); ++t)
        if (flip[t]) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
    if (counts.dropped + counts.flat > 0) keep_triangles(mesh, keep);
    return counts;
}

}  // namespace ice
