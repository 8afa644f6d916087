// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/peers/section.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Partition_traits_2.h>
#include <CGAL/partition_2.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <list>

#include "common/base/error.hpp"

namespace ice::peers {

namespace {

constexpr double kSamePoint = 1e-9;  // [m]; the meshes are welded, their sections repeat exactly

struct Segment {
    Vec2 start, end;
};

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

// Where the edge from a to b crosses y = 0.
Vec2 crossing(const Vec3& a, const Vec3& b) {
    const Vec3 p = a + (b - a) * (a.y() / (a.y() - b.y()));
    return {p.x(), p.z()};
}

std::vector<Segment> cut_triangles(const TriangleMesh& mesh) {
    std::vector<Segment> out;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        std::vector<Vec2> points;
        for (int k = 0; k < 3; ++k) {
            const Vec3 a = mesh.corner(t, k), b = mesh.corner(t, (k + 1) % 3);
            if (a.y() == 0.0)
                throw bad_input("mesh", "a vertex lies in the plane y = 0",
                                "use a set made with spherize --slice y=0");
            if ((a.y() < 0.0) != (b.y() < 0.0)) points.push_back(crossing(a, b));
        }
        if (points.size() != 2 || (points[1] - points[0]).norm() < kSamePoint) continue;
        // solid to the left: the outward normal points to the right
        const Vec3 n = mesh.area_vector(t);
        if (cross(points[1] - points[0], Vec2(n.x(), n.z())) > 0.0) std::swap(points[0], points[1]);
        out.push_back({points[0], points[1]});
    }
    return out;
}

double distance_to_edge(const Vec2& p, const Vec2& a, const Vec2& b) {
    const double along = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    return (p - a - along * (b - a)).norm();
}

double distance_to_boundary(const Polygon& polygon, const Vec2& p) {
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < polygon.size(); ++k)
        best = std::min(best, distance_to_edge(p, polygon[k], polygon[(k + 1) % polygon.size()]));
    return best;
}

bool edges_cross(const Polygon& a, const Polygon& b) {
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t j = 0; j < b.size(); ++j) {
            const Vec2 &p = a[i], &q = a[(i + 1) % a.size()];
            const Vec2 &r = b[j], &s = b[(j + 1) % b.size()];
            if (cross(q - p, r - p) * cross(q - p, s - p) < 0.0 &&
                cross(s - r, p - r) * cross(s - r, q - r) < 0.0)
                return true;
        }
    return false;
}

}  // namespace

Polygon outline_of(const TriangleMesh& mesh) {
    std::vector<Segment> left = cut_triangles(mesh);
    if (left.empty()) throw bad_input("mesh", "does not cross the plane y = 0", "use another mesh");
    Polygon loop{left.back().start};
    Vec2 end = left.back().end;
    left.pop_back();
    while (!left.empty()) {
        const auto next = std::find_if(left.begin(), left.end(), [&](const Segment& s) {
            return (s.start - end).norm() < kSamePoint;
        });
        if (next == left.end()) break;
        loop.push_back(end);
        end = next->end;
        left.erase(next);
    }
    if (!left.empty() || (end - loop.front()).norm() >= kSamePoint)
        throw bad_input("mesh", "its section by y = 0 is not one closed loop", "use another mesh");

    Polygon out;
    for (std::size_t k = 0; k < loop.size(); ++k) {
        const Vec2 in = (loop[k] - loop[(k + loop.size() - 1) % loop.size()]).normalized();
        const Vec2 on = (loop[(k + 1) % loop.size()] - loop[k]).normalized();
        if (std::abs(cross(in, on)) > kSamePoint) out.push_back(loop[k]);
    }
    return out;
}

std::vector<Polygon> convex_parts(const Polygon& polygon) {
    using Traits = CGAL::Partition_traits_2<CGAL::Exact_predicates_inexact_constructions_kernel>;
    std::list<Traits::Point_2> points;
    for (const Vec2& p : polygon) points.emplace_back(p.x(), p.y());
    std::list<Traits::Polygon_2> parts;
    CGAL::optimal_convex_partition_2(points.begin(), points.end(), std::back_inserter(parts),
                                     Traits());
    std::vector<Polygon> out;
    for (const auto& part : parts) {
        Polygon corners;
        for (const auto& p : part.container()) corners.emplace_back(p.x(), p.y());
        out.push_back(corners);
    }
    return out;
}

Polygon inset(const Polygon& polygon, double depth) {
    const std::size_t count = polygon.size();
    Polygon out;
    for (std::size_t k = 0; k < count; ++k) {
        const Vec2 in = (polygon[k] - polygon[(k + count - 1) % count]).normalized();
        const Vec2 on = (polygon[(k + 1) % count] - polygon[k]).normalized();
        // the shifted lines p + depth n + s t of both edges meet on the bisector of their normals
        const Vec2 normals = Vec2(-in.y(), in.x()) + Vec2(-on.y(), on.x());
        out.push_back(polygon[k] + 2.0 * depth / normals.squaredNorm() * normals);
    }
    return out;
}

Polygon place(const Polygon& polygon, const Mat3& rotation, const Vec3& position) {
    Polygon out;
    for (const Vec2& p : polygon) {
        const Vec3 q = rotation * Vec3(p.x(), 0.0, p.y()) + position;
        out.emplace_back(q.x(), q.z());
    }
    return out;
}

bool contains(const Polygon& polygon, const Vec2& point) {
    bool inside = false;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vec2 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
        if ((a.y() > point.y()) != (b.y() > point.y()) &&
            point.x() < a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
            inside = !inside;
    }
    return inside;
}

double distance(const Polygon& a, const Polygon& b) {
    if (contains(a, b.front()) || contains(b, a.front()) || edges_cross(a, b)) return 0.0;
    double best = std::numeric_limits<double>::infinity();
    for (const Vec2& p : a) best = std::min(best, distance_to_boundary(b, p));
    for (const Vec2& p : b) best = std::min(best, distance_to_boundary(a, p));
    return best;
}

double overlap_depth(const Polygon& a, const Polygon& b) {
    double deepest = 0.0;
    for (const Vec2& p : a)
        if (contains(b, p)) deepest = std::max(deepest, distance_to_boundary(b, p));
    for (const Vec2& p : b)
        if (contains(a, p)) deepest = std::max(deepest, distance_to_boundary(a, p));
    return deepest;
}

}  // namespace ice::peers
