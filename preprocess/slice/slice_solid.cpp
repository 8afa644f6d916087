// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/slice/slice_solid.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/base/error.hpp"
#include "common/geometry/surface_tree.hpp"
#include "preprocess/slice/section_geometry.hpp"

namespace ice {

namespace {

// Points closer than this share of the loop's extent [-] are one: rounding of the cut. A larger
// value drops short edges, a smaller one keeps edges that rounding made.
constexpr double kSame = 1e-9;

// Sine of the angle [-] below which two edges count as one straight line. Larger values join facets
// of a bilge, smaller ones leave the cuts of coplanar triangles apart.
constexpr double kStraight = 1e-6;

Vec3 outward_normal(const Vec3& a, const Vec3& b) {
    const Vec3 d = (b - a).normalized();
    // to the right of the way along the loop: outwards of outer loops, into the hole of inner
    // ones
    return Vec3(d.z(), 0.0, -d.x());
}

// The surface whose cut is the edge: of the triangles at its middle, the one whose normal fits.
std::int32_t region_at(const SurfaceTree& tree, const Vec3& middle, const Vec3& normal,
                       double extent) {
    std::vector<Foot> feet;
    tree.within(middle, kStraight * extent, feet);
    // below every cosine
    double best = -2.0;
    std::int32_t chosen = -1;
    for (const Foot& foot : feet) {
        const double fit = tree.normal(foot.triangle).dot(normal);
        // of equal ones the first triangle
        if (fit < best || (fit == best && foot.triangle > chosen)) continue;
        best = fit;
        chosen = foot.triangle;
    }
    return chosen < 0 ? 0 : tree.mesh().region[static_cast<std::size_t>(chosen)];
}

std::vector<SectionEdge> make_loop(const std::vector<Vec3>& points, const SurfaceTree& tree,
                                   double extent, double offset) {
    std::vector<SectionEdge> edges;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const Vec3& a = points[k];
        const Vec3& b = points[(k + 1) % points.size()];
        if ((b - a).norm() <= kSame * extent) continue;
        const Vec3 normal = outward_normal(a, b);
        const Vec3 middle = 0.5 * (a + b) + offset * Vec3::UnitY();
        edges.push_back({a, b, normal, region_at(tree, middle, normal, extent)});
    }
    // joins edges that the diagonals of flat faces cut apart
    std::vector<SectionEdge> joined;
    for (const SectionEdge& edge : edges) {
        if (!joined.empty() && joined.back().region == edge.region &&
            std::abs(joined.back().normal.cross(edge.normal).y()) < kStraight &&
            joined.back().normal.dot(edge.normal) > 0.0) {
            joined.back().b = edge.b;
            joined.back().normal = outward_normal(joined.back().a, edge.b);
        } else {
            joined.push_back(edge);
        }
    }
    // the loop may have begun in the middle of a straight line
    if (joined.size() > 2 && joined.front().region == joined.back().region &&
        std::abs(joined.front().normal.cross(joined.back().normal).y()) < kStraight &&
        joined.front().normal.dot(joined.back().normal) > 0.0) {
        joined.front().a = joined.back().a;
        joined.pop_back();
    }
    return joined;
}

}  // namespace

Section slice_solid(const TriangleMesh& mesh, double offset) {
    const auto polylines = cut_by_plane(mesh, offset);
    Eigen::AlignedBox3d box;
    for (const Vec3& v : mesh.vertices) box.extend(v);
    const SurfaceTree tree(mesh);
    Section section;
    for (const auto& points : orient_loops(polylines)) {
        auto loop = make_loop(points, tree, box.diagonal().norm(), offset);
        // fewer edges enclose nothing
        if (loop.size() >= 3) section.loops.push_back(std::move(loop));
    }
    if (section.loops.empty())
        throw bad_input("--slice",
                        fmt::format("the plane y = {:g} m does not cut the solid", offset),
                        fmt::format("the solid reaches from y = {:.4g} to {:.4g} m", box.min().y(),
                                    box.max().y()));
    return section;
}

TriangleMesh extrude(const Section& section, const std::vector<std::string>& region_names) {
    TriangleMesh mesh;
    mesh.region_names = region_names;
    std::vector<std::vector<Vec3>> loops;
    for (const auto& loop : section.loops) {
        const auto first = static_cast<std::int32_t>(mesh.vertices.size());
        const auto n = static_cast<std::int32_t>(loop.size());
        loops.emplace_back();
        for (const SectionEdge& edge : loop) {
            loops.back().push_back(edge.a);
            mesh.vertices.push_back(edge.a - 0.5 * Vec3::UnitY());
            mesh.vertices.push_back(edge.a + 0.5 * Vec3::UnitY());
        }
        for (std::int32_t k = 0; k < n; ++k) {
            const std::int32_t s = first + 2 * k, t = first + 2 * ((k + 1) % n);
            // outer loops run anticlockwise in x-z, holes clockwise: these two triangles of a side
            // face outward
            for (const auto& triangle : {std::array{s, t + 1, t}, std::array{s, s + 1, t + 1}}) {
                mesh.triangles.push_back(triangle);
                mesh.region.push_back(loop[static_cast<std::size_t>(k)].region);
            }
        }
    }
    // corner k of the flattened loops is vertex 2 k at y = -0.5 and 2 k + 1 at y = +0.5
    for (const auto& [a, b, c] : triangulate(loops)) {
        mesh.triangles.push_back({2 * a, 2 * b, 2 * c});
        mesh.triangles.push_back({2 * a + 1, 2 * c + 1, 2 * b + 1});
        mesh.region.insert(mesh.region.end(), 2, 0);
    }
    return mesh;
}

}  // namespace ice
