// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/feature/section_area.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/geometry/plane_crossing.hpp"
#include "common/math/ordered_products.hpp"

namespace ice {

namespace {

// Keeps the part of work.face in the half-space (Sutherland and Hodgman).
void clip(const Vec3& normal, double offset, SectionWork& work) {
    auto& [face, rest] = work;
    rest.clear();
    for (std::size_t k = 0; k < face.size(); ++k) {
        const Vec3 &p = face[k], &q = face[(k + 1) % face.size()];
        const double hp = ordered_dot(normal, p) - offset, hq = ordered_dot(normal, q) - offset;
        if (hp <= 0.0) rest.push_back(p);
        if ((hp <= 0.0) != (hq <= 0.0)) rest.push_back(plane_crossing(p, hp, q, hq));
    }
    face.swap(rest);
}

// Area of a plane polygon along a direction [m2], twice; positive where it runs anticlockwise.
double twice_area(const std::vector<Vec3>& polygon, const Vec3& direction) {
    double sum = 0.0;
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k)
        sum += ordered_dot(
            direction, Vec3((polygon[k] - polygon[0]).cross(Vec3(polygon[k + 1] - polygon[0]))));
    return sum;
}

}  // namespace

double section_area(const ConvexPiece& a, const ConvexPiece& b, const RelativePose& pose,
                    const Vec3& n, double reach, SectionWork& work) {
    double sum = 0.0;
    const Vec3 towards = ordered_transposed(pose.rotation, n);
    for (std::size_t k = 0; k < b.plane_count(); ++k) {
        if (ordered_dot(b.normals[k], towards) >= 0.0) continue;
        work.face.clear();
        for (const std::int32_t corner : b.loops[k])
            work.face.push_back(
                ordered_product(pose.rotation, b.corners[static_cast<std::size_t>(corner)]) +
                pose.translation);
        for (std::size_t m = 0; m < a.plane_count() && !work.face.empty(); ++m)
            clip(a.normals[m], a.offsets[m] + reach, work);
        sum += std::max(0.0, -twice_area(work.face, n));
    }
    return 0.5 * sum;
}

double slice_area(const ConvexPiece& piece, const Vec3& n, double offset) {
    // The slice's edges, one in each plane that is cut, each in the direction of the plane's
    // outline: twice the area is the sum of their moments about the slice's first corner.
    double sum = 0.0;
    bool any = false;
    Vec3 first = Vec3::Zero();
    for (const std::vector<std::int32_t>& loop : piece.loops) {
        Vec3 out = first, in = first;
        bool crosses = false;
        for (std::size_t k = 0; k < loop.size(); ++k) {
            const Vec3 p = piece.corners[static_cast<std::size_t>(loop[k])],
                       q = piece.corners[static_cast<std::size_t>(loop[(k + 1) % loop.size()])];
            const double hp = ordered_dot(n, p) - offset, hq = ordered_dot(n, q) - offset;
            if ((hp <= 0.0) == (hq <= 0.0)) continue;
            (hp <= 0.0 ? out : in) = plane_crossing(p, hp, q, hq);
            crosses = true;
        }
        if (!crosses) continue;
        if (!any) first = out;
        any = true;
        sum += ordered_dot(n, Vec3((in - first).cross(Vec3(out - first))));
    }
    return std::abs(0.5 * sum);
}

}  // namespace ice
