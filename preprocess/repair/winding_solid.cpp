// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/repair/winding_solid.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/parallel.hpp"
#include "common/geometry/surface_tree.hpp"
#include "preprocess/measure/row_crossings.hpp"
#include "preprocess/repair/contour_grid.hpp"
#include "preprocess/repair/sharpen_contour.hpp"

namespace ice {

namespace {

// Cells along the longest side [-]: half a metre on a ship of 100 m. More keep finer parts and take
// time and memory with their cube.
constexpr double kCells = 200.0;
// Most nodes of the grid [-], else cells grow: about a second. A larger value keeps finer parts and
// takes longer.
constexpr double kNodes = 2.0e6;
// Most nodes for the finer cells of a caller [-], which are no larger than the spheres' radius. A
// larger value keeps finer parts and takes longer.
constexpr double kFinestNodes = 8.0e6;
// Cells along the longest side [-] in the search for voids. It sets the widest gap that counts as
// closed, a hundredth of the length. A larger value closes narrower gaps only and takes longer.
constexpr double kCoarse = 100.0;
// Distance to the surface over a cell [-] within which a node is no way out: a passage must be
// wider than 1.2 cells. A larger value takes wider passages for closed, a smaller one lets narrower
// ones drain a void.
constexpr double kSealed = 0.6;
// Steps towards the surface at most [-]; each is as long as the distance left. Fewer end before
// slanted faces, more take longer.
constexpr int kSteps = 16;
// Distance over a cell [-] at which the surface counts as reached. A larger value leaves the
// contour off the surface by as much, a smaller one takes more steps.
constexpr double kReached = 1.0 / 256;

Grid make_grid(const TriangleMesh& mesh, double cells, double finest) {
    Eigen::AlignedBox3d box;
    for (const Vec3& v : mesh.vertices) box.extend(v);
    const Vec3 size = box.sizes();
    Grid grid;
    const auto nodes_at = [&](double step) { return ((size / step).array() + 4.0).prod(); };
    const auto coarsen = [&](double step, double most) {
        while (nodes_at(step) > most) step *= 1.05;
        return step;
    };
    grid.step = coarsen(size.maxCoeff() / cells, kNodes);
    if (finest > 0.0 && finest < grid.step) grid.step = coarsen(finest, kFinestNodes);
    // Off the faces of the model, which lie at round numbers: a row along a face would cross it
    // nowhere or everywhere. Three irrational shares of a cell, so that no two axes agree.
    const Vec3 shift(0.3819660113, 0.4142135624, 0.4472135955);
    grid.origin = box.min() - grid.step * (Vec3::Ones() + shift);
    for (int d = 0; d < 3; ++d)
        grid.nodes[static_cast<std::size_t>(d)] =
            static_cast<std::int32_t>(std::ceil(size[d] / grid.step)) + 4;
    return grid;
}

// Nodes with a positive winding number, from rows along x.
std::vector<std::uint8_t> mark_inside(const TriangleMesh& mesh, const Grid& grid,
                                      double* open_share) {
    const RowGrid rows{0,    grid.origin, Vec3::Constant(grid.step), grid.nodes[1], grid.nodes[2],
                       false};
    const auto crossings = cross_rows(mesh, rows);
    std::vector<std::uint8_t> inside(grid.size(), 0);
    double crossed = 0.0, open = 0.0;
    for (std::size_t k = 0; k < crossings.size();) {
        const std::int32_t row = crossings[k].row;
        const auto y = static_cast<std::size_t>(row / grid.nodes[2]);
        const auto z = static_cast<std::size_t>(row % grid.nodes[2]);
        const std::size_t first = static_cast<std::size_t>(grid.nodes[0]) *
                                  (y + static_cast<std::size_t>(grid.nodes[1]) * z);
        // A row crosses the surface with signs: their running sum is the winding number along it.
        int winding = 0;
        for (; k < crossings.size() && crossings[k].row == row; ++k) {
            const auto node = [&](double x) {
                return static_cast<std::size_t>(std::ceil((x - grid.origin.x()) / grid.step));
            };
            if (winding > 0)
                for (std::size_t x = node(crossings[k - 1].depth); x < node(crossings[k].depth);
                     ++x)
                    inside[first + x] = 1;
            winding += crossings[k].sign;
        }
        crossed += 1.0;
        open += winding != 0 ? 1.0 : 0.0;
    }
    *open_share = open / std::max(crossed, 1.0);
    return inside;
}

// Nodes of voids that lead outside through nothing wider than about a cell.
std::vector<std::size_t> find_voids(const Grid& grid, const std::vector<std::uint8_t>& inside,
                                    const SurfaceTree& tree) {
    std::vector<std::uint8_t> shut(inside.size());
    parallel_for(inside.size(), 1000, [&](std::size_t k) {
        // Passages narrower than about a cell count as closed: hatches and gaps between plates do
        // not drain a void.
        shut[k] = inside[k] || !tree.is_clear(grid.at(k), kSealed * grid.step);
    });
    std::vector<std::uint8_t> filled = shut;
    fill_voids(grid, filled);
    std::vector<std::size_t> voids;
    for (std::size_t k = 0; k < filled.size(); ++k)
        if (filled[k] && !shut[k]) voids.push_back(k);
    // the nodes between them and the surface belong to them
    const auto nx = static_cast<std::size_t>(grid.nodes[0]);
    const auto nxy = nx * static_cast<std::size_t>(grid.nodes[1]);
    std::vector<std::uint8_t> known(inside);
    for (const std::size_t k : voids) known[k] = 1;
    for (std::size_t n = 0, core = voids.size(); n < core; ++n)
        for (const std::size_t step : {std::size_t{1}, nx, nxy})
            for (const std::size_t other : {voids[n] - step, voids[n] + step})
                if (!known[other]) {
                    known[other] = 1;
                    voids.push_back(other);
                }
    return voids;
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

std::pair<double, Vec3> farthest_outside(const TriangleMesh& mesh, const TriangleMesh& solid) {
    const SurfaceTree tree(solid);
    std::vector<double> outside(mesh.vertices.size(), 0.0);
    parallel_for(outside.size(), 100, [&](std::size_t k) {
        // Of vertices only: the largest distance of a coarse triangle may lie inside it, which is
        // accepted.
        const Foot foot = tree.closest(mesh.vertices[k]);
        if (!foot.inside) outside[k] = foot.distance;
    });
    const auto most = std::max_element(outside.begin(), outside.end());
    return {*most, mesh.vertices[static_cast<std::size_t>(most - outside.begin())]};
}

EnclosedVoids enclosed_voids(const TriangleMesh& mesh) {
    const Grid grid = make_grid(mesh, kCoarse, 0.0);
    double unclear = 0.0;
    const std::vector<std::uint8_t> inside = mark_inside(mesh, grid, &unclear);
    const SurfaceTree tree(mesh);
    EnclosedVoids out;
    out.passage = 2.0 * kSealed * grid.step;
    out.volume =
        static_cast<double>(find_voids(grid, inside, tree).size()) * std::pow(grid.step, 3);
    return out;
}

WindingSolid winding_solid(const TriangleMesh& mesh, SolidKind kind, double finest) {
    const Grid grid = make_grid(mesh, kCells, finest);
    WindingSolid out;
    out.cell = grid.step;
    std::vector<std::uint8_t> inside = mark_inside(mesh, grid, &out.unclear);
    const SurfaceTree tree(mesh);
    if (kind == SolidKind::envelope) {
        for (const std::size_t k : find_voids(grid, inside, tree)) inside[k] = 1;
        fill_voids(grid, inside);
    }
    out.mesh = contour_grid(grid, inside, [&](const Vec3& in, const Vec3& outer) {
        // from outside, a step as long as the distance to the surface cannot pass it
        const double length = (outer - in).norm();
        double left = length;
        for (int k = 0; k < kSteps && left > 0.0; ++k) {
            const double distance = tree.closest(in + left / length * (outer - in)).distance;
            left -= distance;
            if (distance < kReached * grid.step) break;
        }
        return left / length;
    });
    // The contour has the grid's steps rounded off: its vertices are brought back to the edges of
    // the source, and its triangles get the source's regions.
    if (out.mesh.triangles.empty()) return out;
    sharpen_contour(out.mesh, tree, grid.step);
    copy_regions(mesh, out.mesh);
    return out;
}

}  // namespace ice
