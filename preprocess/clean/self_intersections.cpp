// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/clean/self_intersections.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

namespace ice {

std::vector<std::pair<std::size_t, std::size_t>> find_self_intersections(const TriangleMesh& mesh) {
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
    Surface surface;
    for (const Vec3& v : mesh.vertices) surface.add_vertex(Kernel::Point_3(v.x(), v.y(), v.z()));
    for (const auto& t : mesh.triangles)
        surface.add_face(Surface::Vertex_index(static_cast<unsigned>(t[0])),
                         Surface::Vertex_index(static_cast<unsigned>(t[1])),
                         Surface::Vertex_index(static_cast<unsigned>(t[2])));
    std::vector<std::pair<Surface::Face_index, Surface::Face_index>> found;
    CGAL::Polygon_mesh_processing::self_intersections(surface, std::back_inserter(found));
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (const auto& [a, b] : found) pairs.emplace_back(a.idx(), b.idx());
    return pairs;
}

}  // namespace ice
