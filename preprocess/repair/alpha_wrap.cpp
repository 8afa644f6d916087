// SPDX-License-Identifier: GPL-3.0-or-later
// CGAL's alpha wrap of a mesh. The result is empty where CGAL gives up.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/alpha_wrap_3.h>

#include <algorithm>
#include <exception>

#include "preprocess/repair/wrap_solid.hpp"

namespace ice {

TriangleMesh alpha_wrap(const TriangleMesh& mesh, double alpha, double offset) {
    // exact predicates decide sides; coordinates of the wrap may round
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
    std::vector<Kernel::Point_3> points;
    std::vector<std::vector<std::size_t>> faces;
    for (const Vec3& v : mesh.vertices) points.emplace_back(v.x(), v.y(), v.z());
    for (const auto& t : mesh.triangles) faces.emplace_back(t.begin(), t.end());
    // CGAL 5.5 leaves triangles without area out, and crashes when none is left
    if (std::all_of(faces.begin(), faces.end(), [&](const std::vector<std::size_t>& f) {
            return CGAL::collinear(points[f[0]], points[f[1]], points[f[2]]);
        }))
        return {};
    TriangleMesh out;
    try {
        Surface wrap;
        CGAL::alpha_wrap_3(points, faces, alpha, offset, wrap);
        for (const auto v : wrap.vertices()) {
            const auto& p = wrap.point(v);
            out.vertices.emplace_back(p.x(), p.y(), p.z());
        }
        for (const auto f : wrap.faces()) {
            std::array<std::int32_t, 3> t{};
            std::size_t k = 0;
            for (const auto v : CGAL::vertices_around_face(wrap.halfedge(f), wrap))
                t[k++] = static_cast<std::int32_t>(v.idx());
            out.triangles.push_back(t);
        }
    } catch (const std::exception&) {  // CGAL gives up: the caller tries another way
        return {};
    }
    out.region.assign(out.triangles.size(), 0);
    return out;
}

}  // namespace ice
