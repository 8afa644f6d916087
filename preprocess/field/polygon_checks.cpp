// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/field/polygon_checks.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2_algorithms.h>

#include <algorithm>
#include <array>
#include <limits>

#include "common/base/assert.hpp"
#include "preprocess/slice/section_geometry.hpp"

namespace ice {

namespace {

using Triangle = std::array<Vec2, 3>;

std::vector<Triangle> triangles_of(const Outline& outline) {
    std::vector<Vec3> loop;  // triangulate works in x-z
    for (const Vec2& p : outline) loop.emplace_back(p.x(), 0.0, p.y());
    std::vector<Triangle> out;
    for (const auto& [a, b, c] : triangulate({loop}))
        out.push_back({outline[static_cast<std::size_t>(a)], outline[static_cast<std::size_t>(b)],
                       outline[static_cast<std::size_t>(c)]});
    return out;
}

// Separating axes: the least overlap over the normals of all edges; negative where one separates
// them.
double depth_of(const Triangle& a, const Triangle& b) {
    double least = std::numeric_limits<double>::infinity();
    for (const Triangle* t : {&a, &b})
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec2 edge = (*t)[(k + 1) % 3] - (*t)[k];
            // Outward for a triangle that runs anticlockwise.
            const Vec2 out = Vec2(edge.y(), -edge.x()).normalized();
            const Triangle& other = t == &a ? b : a;
            // how far the other triangle reaches behind this edge's line
            double inside = -std::numeric_limits<double>::infinity();
            for (const Vec2& p : other) inside = std::max(inside, out.dot((*t)[k] - p));
            least = std::min(least, inside);
        }
    return least;
}

}  // namespace

bool is_simple(const Outline& outline) {
    // Exact predicates: whether two edges touch must not depend on rounding.
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    std::vector<Kernel::Point_2> points;
    for (const Vec2& p : outline) points.emplace_back(p.x(), p.y());
    return CGAL::is_simple_2(points.begin(), points.end(), Kernel());
}

double overlap_depth(const Outline& a, const Outline& b) {
    ICE_ASSERT(area_of(a) > 0.0 && area_of(b) > 0.0);
    Rectangle box_a, box_b;
    for (const Vec2& p : a) box_a.extend(p);
    for (const Vec2& p : b) box_b.extend(p);
    // Triangles, because floes may be concave, and separating axes are for convex shapes.
    if (!box_a.intersects(box_b)) return 0.0;
    const std::vector<Triangle> of_b = triangles_of(b);
    double deepest = 0.0;
    for (const Triangle& ta : triangles_of(a))
        for (const Triangle& tb : of_b) deepest = std::max(deepest, depth_of(ta, tb));
    return deepest;
}

}  // namespace ice
