// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Surface_mesh.h>

#include <exception>

#include "preprocess/repair/unite_parts.hpp"

namespace ice {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

Surface to_surface(const TriangleMesh& mesh) {
    Surface out;
    for (const Vec3& v : mesh.vertices) out.add_vertex(Kernel::Point_3(v.x(), v.y(), v.z()));
    for (const auto& t : mesh.triangles)
        out.add_face(Surface::Vertex_index(static_cast<unsigned>(t[0])),
                     Surface::Vertex_index(static_cast<unsigned>(t[1])),
                     Surface::Vertex_index(static_cast<unsigned>(t[2])));
    return out;
}

TriangleMesh to_mesh(Surface& surface) {
    surface.collect_garbage();
    TriangleMesh out;
    for (const auto v : surface.vertices()) {
        const auto& p = surface.point(v);
        out.vertices.emplace_back(p.x(), p.y(), p.z());
    }
    for (const auto f : surface.faces()) {
        std::array<std::int32_t, 3> t;
        std::size_t k = 0;
        for (const auto v : CGAL::vertices_around_face(surface.halfedge(f), surface))
            if (k < 3) t[k++] = static_cast<std::int32_t>(v.idx());
        out.triangles.push_back(t);
    }
    out.region.assign(out.triangles.size(), 0);
    return out;
}

}  // namespace

std::optional<TriangleMesh> unite_bodies(const std::vector<TriangleMesh>& bodies) {
    namespace PMP = CGAL::Polygon_mesh_processing;
    try {
        Surface sum = to_surface(bodies.front());
        for (std::size_t k = 1; k < bodies.size(); ++k) {
            Surface next = to_surface(bodies[k]), result;
            if (sum.number_of_faces() == 0 || next.number_of_faces() == 0) return std::nullopt;
            if (!PMP::corefine_and_compute_union(
                    sum, next, result, CGAL::parameters::throw_on_self_intersection(true),
                    CGAL::parameters::throw_on_self_intersection(true)))
                return std::nullopt;
            sum = std::move(result);
        }
        return to_mesh(sum);
    } catch (const std::exception&) {  // CGAL gives up: the caller tries another way
        return std::nullopt;
    }
}

}  // namespace ice
