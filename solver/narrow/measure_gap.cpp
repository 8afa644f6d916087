// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/measure_gap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/narrow/gap_rule.hpp"
#include "solver/shape/shape.hpp"

namespace ice {

namespace {

// A corner is over a face as long as it is not this many radii beyond the face's edge.
constexpr double kBeyond = 0.01;

// Squared distances (in radii) that count as equal.
constexpr double kFlush = 1e-3;

// The direction of d itself inside the cone of normals, else the cone's nearest to it.
Vec3 nearest_normal(const SphereSurface& s, const Vec3& d) {
    if (s.spread_cos == 1.0) return s.normal;
    const double distance = d.norm();
    if (distance == 0.0) return s.normal;  // no direction: the pair will be invalid
    const Vec3 u = d / distance;
    const double along = u.dot(s.normal);
    if (along >= s.spread_cos) return u;
    const Vec3 across = u - along * s.normal;
    const double length = across.norm();
    if (length == 0.0) return s.normal;  // u points straight inwards: the pair will be invalid
    return s.spread_cos * s.normal + (s.spread_sin / length) * across;
}

// Is n an outward normal of the surface there? No face that stands all but upright: its edges are
// before it.
bool belongs(const SphereSurface& s, const Vec3& n, double most_along) {
    if (s.faces.count > 0) return s.faces.have(n, most_along);
    return s.normal.dot(n) >= std::min(kLeaning, s.spread_cos);
}

// Of the directions that may part two local solids the one with the largest gap.
struct Parting {
    Vec3 normal = Vec3::Zero();  // zero where the solids do not face each other
    bool crossing = false;       // the normal across both edges, not a face's
};

Parting parting_normal(const SphereSurface& a, const SphereSurface& b, const Vec3& d) {
    Parting best;
    const Vec3 between = support_point(b, -a.normal) - support_point(a, -b.normal);
    double widest = -std::numeric_limits<double>::infinity();
    const auto attempt = [&](const Vec3& n, bool crossing) {
        const double gap = n.dot(between);
        if (gap <= widest) return;
        widest = gap;
        best = {n, crossing};
    };
    // a face's normal is one of its own edge's or corner's
    for (int k = 0; k < a.faces.count; ++k) {
        const Vec3& n = a.faces.normal[static_cast<std::size_t>(k)];
        if (n.dot(d) > 0.0 && b.faces.have(-n, kSlantOnEdge)) attempt(n, false);
    }
    for (int k = 0; k < b.faces.count; ++k) {
        const Vec3 n = -b.faces.normal[static_cast<std::size_t>(k)];
        if (n.dot(d) > 0.0 && a.faces.have(n, kSlantOnEdge)) attempt(n, false);
    }
    if (a.faces.count != 2 || b.faces.count != 2) return best;
    const Vec3 across = a.faces.edge().cross(b.faces.edge());
    const double sine = across.norm();
    if (sine <= kParallel) return best;
    const Vec3 n = (across.dot(d) < 0.0 ? -1.0 : 1.0) / sine * across;
    if (n.dot(d) > 0.0 && a.faces.have(n, kSlantOnEdge) && b.faces.have(-n, kSlantOnEdge))
        attempt(n, true);
    return best;
}

// Squared distance [m2] across n from the part of the surface that `s` stands for to a probe's
// point. An edge's sphere stands for the face from above its centre out to the corner, and for
// nothing beyond: there the other body's edge has nothing under it.
double distance_across(const SphereSurface& s, const Vec3& n, const Vec3& probe, bool edges) {
    const auto across = [&](const Vec3& v) { return Vec3(v - v.dot(n) * n); };
    const Vec3 at = across(probe - s.center);
    if (!edges) return at.squaredNorm();
    const Vec3 out = across(s.faces.corner * s.normal);
    const double reach = out.norm();
    if (reach <= kBeyond * s.radius) return at.squaredNorm();
    const double along = at.dot(out) / reach;
    if (along > reach + kBeyond * s.radius) return std::numeric_limits<double>::infinity();
    const double excess = along - std::clamp(along, 0.0, reach);
    return std::max(at.squaredNorm() - along * along, 0.0) + excess * excess;
}

// Midway between two faces' normals; zero where they face away, over 120 degrees apart.
Vec3 mean_normal(const Vec3& normal_a, const Vec3& normal_b) {
    const Vec3 n = normal_a - normal_b;
    const double length = n.norm();
    return length < 1.0 ? Vec3(Vec3::Zero()) : Vec3(n / length);
}

}  // namespace

Vec3 support_point(const SphereSurface& s, const Vec3& n) {
    if (s.faces.count == 0) return s.center + s.radius * n;
    return s.center + s.faces.corner * s.normal;
}

Gap measure_gap_centres(const SphereSurface& a, const SphereSurface& b) {
    const Vec3 d = b.center - a.center;
    const double length = d.norm();
    if (length == 0.0) return {Vec3::UnitZ(), 0.0, 0.0, true, false};
    return {d / length, length - (a.radius + b.radius), 0.0, true, true};
}

Gap measure_gap_surface(const SphereSurface& a, const SphereSurface& b, bool prefer_a) {
    const Vec3 d = b.center - a.center;
    const Gap none{Vec3::UnitZ(), 0.0, 0.0, true, false};
    const bool edges = a.faces.count > 0 && b.faces.count > 0;
    const bool same = std::abs(a.spread_cos - b.spread_cos) <= kSameSpread;
    bool a_is_surface = same || a.spread_cos > b.spread_cos;
    Vec3 n;
    bool crossing = false;
    if (edges) {
        const Parting parting = parting_normal(a, b, d);
        n = parting.normal;
        crossing = parting.crossing;
    } else if (same && !prefer_a)
        n = mean_normal(nearest_normal(a, d), nearest_normal(b, -d));
    else
        n = a_is_surface ? nearest_normal(a, d) : Vec3(-nearest_normal(b, -d));
    if (n.isZero(0.0) || n.dot(d) <= 0.0) return none;
    if (!edges && (!belongs(a, n, kSlantOnFace) || !belongs(b, -n, kSlantOnFace))) return none;
    const Vec3 point_a = support_point(a, n), point_b = support_point(b, -n);
    const double gap = n.dot(point_b - point_a);
    if (crossing) {
        const double apart = (point_b - point_a).squaredNorm() - gap * gap;
        return {n, gap, std::max(apart, 0.0), a_is_surface, true, true};
    }
    const double under_a = distance_across(a, n, point_b, edges);
    const double under_b = distance_across(b, n, point_a, edges);
    // flush edges differ by rounding only: then a, step after step
    if (edges) a_is_surface = under_a <= under_b + kFlush * a.radius * a.radius;
    return {n, gap, a_is_surface ? under_a : under_b, a_is_surface, true};
}

}  // namespace ice
