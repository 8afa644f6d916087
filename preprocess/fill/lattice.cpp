// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/fill/lattice.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "common/base/error.hpp"
#include "common/base/parallel.hpp"

namespace ice {

namespace {

constexpr double kRounding = 1e-9;   // of the clearance
constexpr double kSquare = 1e-6;     // sine of the tilt below which a face is square to an axis
constexpr double kMostPoints = 1e9;  // lattice points of the box: memory for one byte each

// Where along `axis` the flat face with the largest area lies, or the lower end of the box.
double anchor(const SurfaceTree& tree, const Eigen::AlignedBox3d& box, int axis) {
    const TriangleMesh& mesh = tree.mesh();
    const double grain = 1e-9 * box.diagonal().norm();
    std::map<std::int64_t, double> areas;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Vec3& n = tree.normal(static_cast<std::int32_t>(t));
        if (std::abs(n[axis]) < 1.0 - 0.5 * kSquare * kSquare) continue;
        areas[static_cast<std::int64_t>(std::llround((mesh.corner(t, 0)[axis] - box.min()[axis]) /
                                                     grain))] += mesh.area_vector(t).norm();
    }
    double best = 0.0, at = box.min()[axis];
    for (const auto& [position, area] : areas) {
        if (area <= best * (1.0 + 1e-9)) continue;  // the lower of two equal faces
        best = area;
        at = box.min()[axis] + static_cast<double>(position) * grain;
    }
    return at;
}

}  // namespace

Lattice fill_lattice(const SurfaceTree& tree, double radius, double clearance, int dimension) {
    Eigen::AlignedBox3d box;
    for (const Vec3& v : tree.mesh().vertices) box.extend(v);
    const double pitch = 2.0 * radius;
    std::array<std::int64_t, 3> count{};
    Vec3 first;
    for (int d = 0; d < 3; ++d) {
        const auto k = static_cast<std::size_t>(d);
        if (dimension == 2 && d == 1) {
            first[d] = 0.0;
            count[k] = 1;
            continue;
        }
        const double face = anchor(tree, box, d);
        const double below = std::floor((face - box.min()[d]) / pitch + kRounding);
        first[d] = face + radius - below * pitch;
        if (first[d] - pitch > box.min()[d]) first[d] -= pitch;
        count[k] =
            static_cast<std::int64_t>(std::floor((box.max()[d] - first[d]) / pitch + kRounding)) +
            1;
    }
    const double total = static_cast<double>(count[0]) * static_cast<double>(count[1]) *
                         static_cast<double>(count[2]);
    if (total > kMostPoints)
        throw bad_input("--radius",
                        fmt::format("the solid's box holds {:.2g} lattice points", total),
                        "use a larger radius, or --mode surface");

    std::vector<std::uint8_t> full(static_cast<std::size_t>(total));
    const auto point = [&](std::size_t k) {
        const auto nx = static_cast<std::size_t>(count[0]), ny = static_cast<std::size_t>(count[1]);
        return Vec3(first + pitch * Vec3(static_cast<double>(k % nx),
                                         static_cast<double>(k / nx % ny),
                                         static_cast<double>(k / (nx * ny))));
    };
    parallel_for(full.size(), 4096, [&](std::size_t k) {
        const Foot foot = tree.closest(point(k));
        full[k] = foot.inside && foot.distance >= clearance * (1.0 - kRounding);
    });

    Lattice out;
    const std::size_t stride[3] = {1, static_cast<std::size_t>(count[0]),
                                   static_cast<std::size_t>(count[0] * count[1])};
    for (std::size_t k = 0; k < full.size(); ++k) {
        if (!full[k]) continue;
        bool outer = false;
        for (std::size_t d = 0; d < 3; ++d) {
            if (count[d] == 1 && dimension == 2 && d == 1) continue;
            const std::size_t at = k / stride[d] % static_cast<std::size_t>(count[d]);
            outer = outer || at == 0 || at + 1 == static_cast<std::size_t>(count[d]) ||
                    !full[k - stride[d]] || !full[k + stride[d]];
        }
        out.centers.push_back(point(k));
        out.outer.push_back(outer ? 1 : 0);
    }
    return out;
}

}  // namespace ice
