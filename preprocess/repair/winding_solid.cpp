// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/repair/winding_solid.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/parallel.hpp"
#include "preprocess/measure/surface_tree.hpp"
#include "preprocess/measure/winding_number.hpp"
#include "preprocess/repair/contour_grid.hpp"

namespace ice {

namespace {

constexpr double kCells = 200.0;  // along the longest side
constexpr double kNodes = 1.0e6;  // at most, or cells grow
constexpr int kBisections = 7;    // of a cell: 1/128

Grid make_grid(const TriangleMesh& mesh) {
    Eigen::AlignedBox3d box;
    for (const Vec3& v : mesh.vertices) box.extend(v);
    const Vec3 size = box.sizes();
    Grid grid;
    grid.step = size.maxCoeff() / kCells;
    const auto nodes_at = [&](double step) { return ((size / step).array() + 4.0).prod(); };
    while (nodes_at(grid.step) > kNodes) grid.step *= 1.05;
    // off the faces of the model, which lie at round numbers
    const Vec3 shift(0.3819660113, 0.4142135624, 0.4472135955);
    grid.origin = box.min() - grid.step * (Vec3::Ones() + shift);
    for (int d = 0; d < 3; ++d)
        grid.nodes[static_cast<std::size_t>(d)] =
            static_cast<std::int32_t>(std::ceil(size[d] / grid.step)) + 4;
    return grid;
}

}  // namespace

void copy_regions(const TriangleMesh& source, TriangleMesh& mesh) {
    const SurfaceTree tree(source);
    mesh.region_names = source.region_names;
    mesh.region.assign(mesh.triangles.size(), 0);
    parallel_for(mesh.triangles.size(), 100, [&](std::size_t t) {
        const Vec3 middle = (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0;
        const auto nearest = static_cast<std::size_t>(tree.closest(middle).triangle);
        mesh.region[t] = source.region[nearest];
    });
}

WindingSolid winding_solid(const TriangleMesh& mesh, SolidKind kind) {
    const Grid grid = make_grid(mesh);
    const WindingNumber winding(mesh);
    std::vector<std::uint8_t> inside(grid.size(), 0), vague(grid.size(), 0);
    const auto is_inside = [&](const Vec3& p) { return winding.at(p) > 0.5; };
    parallel_for(grid.size(), 100, [&](std::size_t k) {
        const double w = winding.at(grid.at(k));
        inside[k] = w > 0.5;
        vague[k] = w > 0.2 && w < 0.8;
    });
    WindingSolid out;
    out.cell = grid.step;
    if (kind == SolidKind::envelope) fill_voids(grid, inside);
    out.unclear =
        static_cast<double>(std::count(vague.begin(), vague.end(), 1)) /
        std::max<double>(1.0, static_cast<double>(std::count(inside.begin(), inside.end(), 1)));
    out.mesh = contour_grid(grid, inside, [&](const Vec3& in, const Vec3& outer) {
        double low = 0.0, high = 1.0;
        for (int k = 0; k < kBisections; ++k) {
            const double half = 0.5 * (low + high);
            (is_inside(in + half * (outer - in)) ? low : high) = half;
        }
        return 0.5 * (low + high);
    });
    if (!out.mesh.triangles.empty()) copy_regions(mesh, out.mesh);
    return out;
}

}  // namespace ice
