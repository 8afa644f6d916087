// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/clean/self_intersections.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

namespace ice {

std::vector<std::pair<std::size_t, std::size_t>> find_self_intersections(const TriangleMesh& mesh) {
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
    namespace PMP = CGAL::Polygon_mesh_processing;
    std::vector<Kernel::Point_3> points;
    std::vector<std::vector<std::size_t>> faces;
    for (const Vec3& v : mesh.vertices) points.emplace_back(v.x(), v.y(), v.z());
    for (const auto& t : mesh.triangles) faces.emplace_back(t.begin(), t.end());
    // doubles vertices where two sheets meet in a point; faces keep their order
    PMP::orient_polygon_soup(points, faces);
    Surface surface;
    PMP::polygon_soup_to_polygon_mesh(points, faces, surface);
    std::vector<std::pair<Surface::Face_index, Surface::Face_index>> found;
    PMP::self_intersections(surface, std::back_inserter(found));
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (const auto& [a, b] : found) pairs.emplace_back(a.idx(), b.idx());
    return pairs;
}

}  // namespace ice
