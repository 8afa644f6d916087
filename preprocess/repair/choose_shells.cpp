// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/repair/choose_shells.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "common/geometry/winding_number.hpp"
#include "preprocess/clean/find_parts.hpp"
#include "preprocess/clean/keep_triangles.hpp"

namespace ice {

namespace {

// Volume of a shell that counts as none, over its area to the power of 3/2 [-] (a sphere has
// 0.094). Rounding of a doubled sheet is below it; a larger value would drop thin plates.
constexpr double kNoVolume = 1e-9;

struct Shell {
    std::vector<std::int32_t> triangles;
    Eigen::AlignedBox3d box;
    double volume = 0.0;  // signed
    double area = 0.0;
    Vec3 sample = Vec3::Zero();  // in a face: shells may share a corner, but no face
};

std::vector<Shell> find_shells(const TriangleMesh& mesh) {
    const Parts parts = find_parts(mesh);
    std::vector<Shell> shells(static_cast<std::size_t>(parts.count));
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        Shell& shell = shells[static_cast<std::size_t>(parts.of_triangle[t])];
        if (shell.triangles.empty())
            shell.sample = (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0;
        shell.triangles.push_back(static_cast<std::int32_t>(t));
        for (int k = 0; k < 3; ++k) shell.box.extend(mesh.corner(t, k));
    }
    for (Shell& shell : shells) {
        // the origin in the shell itself, so that shells far away keep their digits
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

// Winding number of a shell around a point not on it.
int winding(const TriangleMesh& mesh, const Shell& shell, const Vec3& p) {
    double sum = 0.0;
    for (const std::int32_t t : shell.triangles) {
        const auto tt = static_cast<std::size_t>(t);
        sum += solid_angle(p, mesh.corner(tt, 0), mesh.corner(tt, 1), mesh.corner(tt, 2));
    }
    // in turns: a whole number but for rounding
    return static_cast<int>(std::lround(sum));
}

bool is_flat(const Shell& shell) {
    return std::abs(shell.volume) <= kNoVolume * std::pow(shell.area, 1.5);
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
        // Winding number just outside the shell, of all other shells. Inside it is one more or,
        // where the shell faces inward, one less.
        int outside = 0;
        bool enclosed = false;
        for (const Shell& other : shells) {
            // a shell whose box does not hold this one's cannot be around it
            if (&other == &shell || is_flat(other) || !other.box.contains(shell.box)) continue;
            const int around = winding(mesh, other, shell.sample);
            outside += around;
            enclosed = enclosed || around != 0;
        }
        const int inside = outside + (shell.volume > 0.0 ? 1 : -1);
        // an envelope is bounded by the outermost shells, a solid by shells across which the
        // winding number changes between zero and not zero
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
