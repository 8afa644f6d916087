// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/preprocess/solid_oracle.hpp"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>

#include <cmath>

namespace ice::test {

std::vector<OracleAnswer> ask_oracle(const TriangleMesh& mesh, const std::vector<Vec3>& points) {
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
    using Primitive = CGAL::AABB_face_graph_triangle_primitive<Surface>;
    Surface surface;
    for (const Vec3& v : mesh.vertices) surface.add_vertex(Kernel::Point_3(v.x(), v.y(), v.z()));
    for (const auto& t : mesh.triangles)
        surface.add_face(Surface::Vertex_index(static_cast<unsigned>(t[0])),
                         Surface::Vertex_index(static_cast<unsigned>(t[1])),
                         Surface::Vertex_index(static_cast<unsigned>(t[2])));
    const CGAL::Side_of_triangle_mesh<Surface, Kernel> side(surface);
    CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> tree(faces(surface).first,
                                                               faces(surface).second, surface);
    tree.accelerate_distance_queries();
    std::vector<OracleAnswer> out;
    for (const Vec3& p : points) {
        const Kernel::Point_3 q(p.x(), p.y(), p.z());
        out.push_back({side(q) == CGAL::ON_BOUNDED_SIDE, std::sqrt(tree.squared_distance(q))});
    }
    return out;
}

}  // namespace ice::test
