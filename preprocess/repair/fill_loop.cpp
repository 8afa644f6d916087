// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/repair/fill_loop.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <exception>
#include <set>

namespace ice {

namespace {

using LoopKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triple = std::array<std::int32_t, 3>;

// Corners of a loop [-] up to which CGAL's complete search is used: it is cubic and takes below a
// second for 400. More would find smoother caps of long loops in minutes.
constexpr std::size_t kCubic = 400;

// Triangles that run along the loop, not against it.
void align_with_loop(std::vector<Triple>& patch) {
    bool backwards = false;
    for (const Triple& t : patch)
        for (std::size_t k = 0; k < 3; ++k)
            backwards = backwards || (t[k] == 1 && t[(k + 1) % 3] == 0);
    if (backwards)
        for (Triple& t : patch) std::swap(t[1], t[2]);
}

}  // namespace

std::vector<std::array<std::int32_t, 3>> fill_loop(const std::vector<Vec3>& points,
                                                   const std::vector<Vec3>& across) {
    if (points.size() == 3) return {{0, 1, 2}};
    std::vector<LoopKernel::Point_3> loop, third;
    for (const Vec3& p : points) loop.emplace_back(p.x(), p.y(), p.z());
    for (const Vec3& p : across) third.emplace_back(p.x(), p.y(), p.z());
    std::vector<std::array<std::int32_t, 3>> out;
    std::vector<CGAL::Triple<int, int, int>> patch;
    // beyond kCubic corners only CGAL's search among Delaunay triangles is tried: the complete
    // one is cubic
    try {
        // the flat short cut uses the loop only, not its neighbours
        CGAL::Polygon_mesh_processing::triangulate_hole_polyline(
            loop, third, std::back_inserter(patch),
            CGAL::parameters::use_2d_constrained_delaunay_triangulation(points.size() > 200)
                .do_not_use_cubic_algorithm(points.size() > kCubic));
    } catch (const std::exception&) {  // CGAL gives up: the caller tries another way
        return {};
    }
    for (const auto& t : patch) out.push_back({t.first, t.second, t.third});
    align_with_loop(out);
    return out;
}

std::vector<std::array<std::int32_t, 3>> fill_loop_in_plan(const std::vector<Vec3>& points) {
    using Vertex = CGAL::Triangulation_vertex_base_with_info_2<std::int32_t, LoopKernel>;
    using Face = CGAL::Constrained_triangulation_face_base_2<LoopKernel>;
    using Delaunay = CGAL::Constrained_Delaunay_triangulation_2<
        LoopKernel, CGAL::Triangulation_data_structure_2<Vertex, Face>,
        CGAL::No_constraint_intersection_tag>;
    Delaunay plan;
    std::vector<Triple> out;
    try {
        std::vector<Delaunay::Vertex_handle> handles;
        for (const Vec3& p : points) {
            handles.push_back(plan.insert(LoopKernel::Point_2(p.x(), p.y())));
            handles.back()->info() = static_cast<std::int32_t>(handles.size()) - 1;
        }
        // two points of the loop have the same place in the plan: it has no single height there
        if (plan.number_of_vertices() != points.size()) return {};
        for (std::size_t k = 0; k < handles.size(); ++k)
            plan.insert_constraint(handles[k], handles[(k + 1) % handles.size()]);
    } catch (const Delaunay::Intersection_of_constraints_exception&) {
        return {};
    }
    // outside are the faces that the outer one reaches without crossing the loop
    std::set<Delaunay::Face_handle> outside{plan.infinite_face()};
    std::vector<Delaunay::Face_handle> open{plan.infinite_face()};
    while (!open.empty()) {
        const auto face = open.back();
        open.pop_back();
        for (int k = 0; k < 3; ++k)
            if (!face->is_constrained(k) && outside.insert(face->neighbor(k)).second)
                open.push_back(face->neighbor(k));
    }
    for (const auto& face : plan.finite_face_handles())
        if (!outside.contains(face))
            out.push_back(
                {face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
    // a simple polygon with n corners has n - 2 triangles, any other count means that the loop
    // crosses itself in the plan
    if (out.size() + 2 != points.size()) return {};
    align_with_loop(out);
    return out;
}

}  // namespace ice
