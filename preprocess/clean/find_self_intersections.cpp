// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/clean/find_self_intersections.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>

#include <algorithm>

#include "common/base/parallel.hpp"
#include "common/geometry/find_equal.hpp"

namespace ice {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Triple = std::array<std::int32_t, 3>;
using TriangleBox = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::int32_t>;

struct Soup {
    std::vector<Point> points;
    std::vector<Triple> triangles;  // corners at the same point have the same number

    const Point& at(std::int32_t v) const { return points[static_cast<std::size_t>(v)]; }
    Kernel::Triangle_3 triangle(const Triple& t) const {
        return Kernel::Triangle_3(at(t[0]), at(t[1]), at(t[2]));
    }
};

// Two triangles with one corner in common cross where one's far side meets the other.
bool cross_beyond_corner(const Soup& soup, const Triple& a, const Triple& b, std::int32_t shared) {
    const auto far_side = [&](const Triple& t) {
        const std::size_t k =
            static_cast<std::size_t>(std::find(t.begin(), t.end(), shared) - t.begin());
        return Kernel::Segment_3(soup.at(t[(k + 1) % 3]), soup.at(t[(k + 2) % 3]));
    };
    return CGAL::do_intersect(soup.triangle(a), far_side(b)) ||
           CGAL::do_intersect(soup.triangle(b), far_side(a));
}

// Two triangles with an edge in common lie on each other where they are coplanar and on one side.
bool fold_on_edge(const Soup& soup, const Triple& a, const Triple& b) {
    const auto in = [](const Triple& t, std::int32_t v) {
        return std::find(t.begin(), t.end(), v) != t.end();
    };
    // the corner of each triangle that is not on the common edge
    std::size_t own = 0, other = 0;
    while (in(b, a[own])) ++own;
    while (in(a, b[other])) ++other;
    const Point &p = soup.at(a[(own + 1) % 3]), &q = soup.at(a[(own + 2) % 3]);
    const Point &r = soup.at(a[own]), &s = soup.at(b[other]);
    return CGAL::coplanar(p, q, r, s) && CGAL::coplanar_orientation(p, q, r, s) == CGAL::POSITIVE;
}

bool cross(const Soup& soup, const Triple& a, const Triple& b) {
    std::int32_t shared = -1;
    int count = 0;
    for (const std::int32_t v : a)
        if (std::find(b.begin(), b.end(), v) != b.end()) {
            shared = v;
            ++count;
        }
    // three common corners: one lies on the other
    if (count == 3) return true;
    const auto flat = [&](const Triple& t) {
        return CGAL::collinear(soup.at(t[0]), soup.at(t[1]), soup.at(t[2]));
    };
    // triangles without area are left out
    if (flat(a) || flat(b)) return false;
    if (count == 2) return fold_on_edge(soup, a, b);
    if (count == 1) return cross_beyond_corner(soup, a, b, shared);
    return CGAL::do_intersect(soup.triangle(a), soup.triangle(b));
}

}  // namespace

std::vector<std::pair<std::size_t, std::size_t>> find_self_intersections(const TriangleMesh& mesh) {
    Soup soup;
    soup.points.reserve(mesh.vertices.size());
    for (const Vec3& v : mesh.vertices) soup.points.emplace_back(v.x(), v.y(), v.z());
    // Neighbours touch by design: vertices in one place count as shared, whether welded or not.
    const auto equal = find_equal_vertices(mesh.vertices);
    std::vector<TriangleBox> boxes;
    soup.triangles.reserve(mesh.triangles.size());
    boxes.reserve(mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        Triple corner = mesh.triangles[t];
        for (std::int32_t& v : corner) v = equal[static_cast<std::size_t>(v)];
        soup.triangles.push_back(corner);
        boxes.emplace_back(
            soup.at(corner[0]).bbox() + soup.at(corner[1]).bbox() + soup.at(corner[2]).bbox(),
            static_cast<std::int32_t>(t));
    }
    std::vector<std::pair<std::size_t, std::size_t>> candidates;
    CGAL::box_self_intersection_d(
        boxes.begin(), boxes.end(), [&](const TriangleBox& a, const TriangleBox& b) {
            candidates.emplace_back(std::min(a.info(), b.info()), std::max(a.info(), b.info()));
        });
    // Boxes rule out nearly all pairs; the exact test runs on the rest, each pair by itself.
    std::vector<std::uint8_t> found(candidates.size(), 0);
    parallel_for(candidates.size(), 1000, [&](std::size_t k) {
        found[k] =
            cross(soup, soup.triangles[candidates[k].first], soup.triangles[candidates[k].second]);
    });
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (std::size_t k = 0; k < found.size(); ++k)
        if (found[k]) pairs.push_back(candidates[k]);
    // CGAL's order of boxes is not that of the mesh.
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

}  // namespace ice
