// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/repair/fill_loop.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>

#include <exception>

namespace ice {

std::vector<std::array<std::int32_t, 3>> fill_loop(const std::vector<Vec3>& points,
                                                   const std::vector<Vec3>& across) {
    if (points.size() == 3) return {{0, 1, 2}};
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    std::vector<Kernel::Point_3> loop, third;
    for (const Vec3& p : points) loop.emplace_back(p.x(), p.y(), p.z());
    for (const Vec3& p : across) third.emplace_back(p.x(), p.y(), p.z());
    std::vector<std::array<std::int32_t, 3>> out;
    std::vector<CGAL::Triple<int, int, int>> patch;
    try {
        // the flat short cut looks at the loop only, not at its neighbours
        CGAL::Polygon_mesh_processing::triangulate_hole_polyline(
            loop, third, std::back_inserter(patch),
            CGAL::parameters::use_2d_constrained_delaunay_triangulation(points.size() > 200));
    } catch (const std::exception&) {
        return {};
    }
    bool backwards = false;
    for (const auto& t : patch) {
        out.push_back({t.first, t.second, t.third});
        for (std::size_t k = 0; k < 3; ++k)
            backwards = backwards || (out.back()[k] == 1 && out.back()[(k + 1) % 3] == 0);
    }
    if (backwards)
        for (auto& t : out) std::swap(t[1], t[2]);
    return out;
}

}  // namespace ice
