// SPDX-License-Identifier: GPL-3.0-or-later
//
// Bounds on what measure_gap_surface may answer later. Every normal it may choose is fixed in one
// of the two bodies, so that the gap along it changes by no more than the bodies move; only the
// normal across two edges turns faster than they do.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/narrow/gap_rule.hpp"
#include "solver/narrow/measure_gap.hpp"

namespace ice {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Along the normal across two edges. It turns faster than they do: by an angle / sine.
double least_gap_across(const SphereSurface& a, const SphereSurface& b, const Vec3& across,
                        const Vec3& d, const Vec3& between, double reach, const Leeway& leeway) {
    const double sine = across.norm();
    if (sine <= kParallel - leeway.angle) return kInfinity;
    if (sine <= 2.0 * leeway.angle) return -kInfinity;
    const double turn = leeway.angle / (sine - leeway.angle);
    double least = kInfinity;
    for (const double sign : {-1.0, 1.0}) {
        const Vec3 n = sign / sine * across;
        if (n.dot(d) > -leeway.distance - turn * d.norm() && a.faces.have(n, kSlantOnEdge, turn) &&
            b.faces.have(-n, kSlantOnEdge, turn) &&
            (between - n.dot(between) * n).norm() <=
                reach + leeway.distance + 2.0 * turn * between.norm())
            least = std::min(least, n.dot(between) - turn * between.norm());
    }
    return least;
}

// Two edges or corners: the largest gap of all normals that may part them wins, so one normal that
// will surely be among them is a bound; without one, the least of those that might be. Where each
// of these leaves the other's edge beyond what a sphere stands for there will be no gap.
double least_gap_of_edges(const SphereSurface& a, const SphereSurface& b, double reach,
                          const Leeway& leeway) {
    const Vec3 d = b.center - a.center;
    const Vec3 pa = support_point(a, -b.normal), pb = support_point(b, -a.normal);
    const Vec3 between = pb - pa;
    const double far_sq = (reach + leeway.distance) * (reach + leeway.distance);
    double certain = -kInfinity, possible = kInfinity;
    bool near = false;
    const auto attempt = [&](const Vec3& n, const Faces& other, const Vec3& outward) {
        const double along = n.dot(d), gap = n.dot(between);
        if (along <= -leeway.distance || !other.have(outward, kSlantOnEdge, leeway.angle)) return;
        possible = std::min(possible, gap);
        near = near || distance_across(a, n, pb, true, leeway.distance) <= far_sq ||
               distance_across(b, n, pa, true, leeway.distance) <= far_sq;
        if (along > leeway.distance && other.have(outward, kSlantOnEdge, -leeway.angle))
            certain = std::max(certain, gap);
    };
    for (std::size_t k = 0; k < static_cast<std::size_t>(a.faces.count); ++k)
        attempt(a.faces.normal[k], b.faces, -a.faces.normal[k]);
    for (std::size_t k = 0; k < static_cast<std::size_t>(b.faces.count); ++k)
        attempt(-b.faces.normal[k], a.faces, -b.faces.normal[k]);
    double across = kInfinity;
    for (int ka = 0; ka < a.faces.edges(); ++ka)
        for (int kb = 0; kb < b.faces.edges(); ++kb)
            across =
                std::min(across, least_gap_across(a, b, a.faces.edge(ka).cross(b.faces.edge(kb)), d,
                                                  between, reach, leeway));
    if (!near && across == kInfinity) return kInfinity;
    return certain > -kInfinity ? certain : std::min(possible, across);
}

// May n still be, or come to be, an outward normal of the surface there?
bool may_belong(const SphereSurface& s, const Vec3& n, double angle) {
    if (s.faces.count > 0) return s.faces.have(n, kSlantOnFace, angle);
    return s.normal.dot(n) >= std::min(kLeaning, s.spread_cos) - angle;
}

}  // namespace

double least_gap_surface(const SphereSurface& a, const SphereSurface& b, bool prefer_a,
                         double reach, const Leeway& leeway) {
    if (a.faces.count > 0 && b.faces.count > 0) return least_gap_of_edges(a, b, reach, leeway);
    const Vec3 d = b.center - a.center;
    const bool same = std::abs(a.spread_cos - b.spread_cos) <= kSameSpread;
    const bool a_is_surface = same || a.spread_cos > b.spread_cos;
    // elsewhere than on a face the normal turns with d
    if ((a_is_surface ? a : b).spread_cos != 1.0) return -kInfinity;
    Vec3 n = a_is_surface ? a.normal : Vec3(-b.normal);
    if (same && !prefer_a) {
        if (b.spread_cos != 1.0) return -kInfinity;
        n = a.normal - b.normal;
        if (n.norm() < 1.0 - leeway.angle) return kInfinity;  // the faces look away
        n.normalize();
    }
    if (n.dot(d) <= -leeway.distance || !may_belong(a, n, leeway.angle) ||
        !may_belong(b, -n, leeway.angle))
        return kInfinity;
    const Vec3 between = support_point(b, -n) - support_point(a, n);
    const double gap = n.dot(between);
    const SphereSurface &surface = a_is_surface ? a : b, &probe = a_is_surface ? b : a;
    const Vec3 at = support_point(probe, a_is_surface ? Vec3(-n) : n) - surface.center;
    const double lateral = (at - at.dot(n) * n).norm();
    return lateral > reach + leeway.distance ? kInfinity : gap;
}

}  // namespace ice
