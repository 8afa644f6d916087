// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/slice/section_geometry.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2.h>
#include <CGAL/Polygon_mesh_slicer.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <list>

namespace ice {

namespace {

// Exact predicates: the side of a line on which a corner lies decides between hole and solid, and
// must not depend on rounding. New points are rounded; they decide nothing.
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Polygon = CGAL::Polygon_2<Kernel>;

Polygon to_polygon(const std::vector<Vec3>& loop) {
    Polygon polygon;
    for (const Vec3& p : loop) polygon.push_back(Kernel::Point_2(p.x(), p.z()));
    return polygon;
}

bool inside(const std::vector<Polygon>& polygons, const Kernel::Point_2& p) {
    int count = 0;
    for (const Polygon& polygon : polygons)
        count += polygon.bounded_side(p) == CGAL::ON_BOUNDED_SIDE ? 1 : 0;
    // in an odd number of loops: in the solid, not in a hole
    return count % 2 == 1;
}

}  // namespace

std::vector<std::vector<Vec3>> cut_by_plane(const TriangleMesh& mesh, double offset) {
    using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
    Surface surface;
    for (const Vec3& v : mesh.vertices) surface.add_vertex(Kernel::Point_3(v.x(), v.y(), v.z()));
    for (const auto& t : mesh.triangles)
        surface.add_face(Surface::Vertex_index(static_cast<unsigned>(t[0])),
                         Surface::Vertex_index(static_cast<unsigned>(t[1])),
                         Surface::Vertex_index(static_cast<unsigned>(t[2])));
    std::list<std::vector<Kernel::Point_3>> polylines;
    CGAL::Polygon_mesh_slicer<Surface, Kernel> slicer(surface);
    slicer(Kernel::Plane_3(0, 1, 0, -offset), std::back_inserter(polylines));
    std::vector<std::vector<Vec3>> loops;
    for (const auto& line : polylines) {
        // open lines are edges that lie in the plane without the solid on both sides
        if (line.size() < 4 || line.front() != line.back()) continue;
        loops.emplace_back();
        for (std::size_t k = 0; k + 1 < line.size(); ++k)
            loops.back().emplace_back(line[k].x(), 0.0, line[k].z());
    }
    return loops;
}

std::vector<std::vector<Vec3>> orient_loops(std::vector<std::vector<Vec3>> loops) {
    std::vector<Polygon> polygons;
    for (const auto& loop : loops) polygons.push_back(to_polygon(loop));
    for (std::size_t k = 0; k < loops.size(); ++k) {
        // One corner decides for the whole loop: loops of a closed solid do not cross.
        int around = 0;
        for (std::size_t other = 0; other < loops.size(); ++other)
            around +=
                other != k && polygons[other].bounded_side(polygons[k][0]) == CGAL::ON_BOUNDED_SIDE;
        // outer loops, inside an even number of others, run anticlockwise, holes clockwise
        const bool anticlockwise = polygons[k].orientation() == CGAL::COUNTERCLOCKWISE;
        if (anticlockwise != (around % 2 == 0)) std::reverse(loops[k].begin(), loops[k].end());
    }
    return loops;
}

std::vector<std::array<std::int32_t, 3>> triangulate(const std::vector<std::vector<Vec3>>& loops) {
    using Vertex = CGAL::Triangulation_vertex_base_with_info_2<std::int32_t, Kernel>;
    using Face = CGAL::Constrained_triangulation_face_base_2<Kernel>;
    using Delaunay = CGAL::Constrained_Delaunay_triangulation_2<
        Kernel, CGAL::Triangulation_data_structure_2<Vertex, Face>>;
    Delaunay delaunay;
    std::vector<Polygon> polygons;
    std::int32_t index = 0;
    for (const auto& loop : loops) {
        std::vector<Delaunay::Vertex_handle> handles;
        for (const Vec3& p : loop) {
            handles.push_back(delaunay.insert(Kernel::Point_2(p.x(), p.z())));
            handles.back()->info() = index++;
        }
        for (std::size_t k = 0; k < handles.size(); ++k)
            // Edges of the loops are kept as they are: no triangle lies partly in the solid and
            // partly in a hole, so the centroid decides for the whole triangle.
            delaunay.insert_constraint(handles[k], handles[(k + 1) % handles.size()]);
        polygons.push_back(to_polygon(loop));
    }
    std::vector<std::array<std::int32_t, 3>> out;
    for (const auto& face : delaunay.finite_face_handles()) {
        const auto p = [&](int k) { return face->vertex(k)->point(); };
        // the triangulation fills the convex hull: triangles in holes and bays are left out
        if (inside(polygons, CGAL::centroid(p(0), p(1), p(2))))
            out.push_back(
                {face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
    }
    return out;
}

}  // namespace ice
