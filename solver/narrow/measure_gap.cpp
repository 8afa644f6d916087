// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/measure_gap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/shape/shape.hpp"

namespace ice {

namespace {

// Spreads closer than this (in cosine) count as equally flat: normals are stored as floats.
constexpr double kSameSpread = 1e-6;

// Edges closer to parallel than this (sine) have no normal across both.
constexpr double kParallel = 0.05;

// u itself inside the cone of normals, else the cone's direction nearest to it.
Vec3 nearest_normal(const SphereSurface& s, const Vec3& u) {
    const double along = u.dot(s.normal);
    if (s.spread_sin == 0.0) return s.normal;
    if (along >= s.spread_cos) return u;
    const Vec3 across = u - along * s.normal;
    const double length = across.norm();
    if (length == 0.0) return s.normal;  // u points straight inwards: the pair will be invalid
    return s.spread_cos * s.normal + (s.spread_sin / length) * across;
}

// Of the directions that may part two local solids the one with the largest gap; zero where the
// solids do not face each other.
Vec3 parting_normal(const SphereSurface& a, const SphereSurface& b, const Vec3& d) {
    Vec3 best = Vec3::Zero();
    double widest = -std::numeric_limits<double>::infinity();
    const auto attempt = [&](const Vec3& n) {
        if (n.dot(d) <= 0.0 || n.dot(a.normal) <= 0.0 || n.dot(b.normal) >= 0.0) return;
        const double gap = n.dot(d) - support(a, n) - support(b, -n);
        if (gap <= widest) return;
        widest = gap;
        best = n;
    };
    for (int k = 0; k < a.faces.count; ++k) attempt(a.faces.normal[k]);
    for (int k = 0; k < b.faces.count; ++k) attempt(-b.faces.normal[k]);
    if (a.faces.count != 2 || b.faces.count != 2) return best;
    const Vec3 across = a.faces.normal[0]
                            .cross(a.faces.normal[1])
                            .normalized()
                            .cross(b.faces.normal[0].cross(b.faces.normal[1]).normalized());
    const double sine = across.norm();
    if (sine > kParallel) attempt(across.dot(d) < 0.0 ? Vec3(-across / sine) : Vec3(across / sine));
    return best;
}

// Midway between two faces' normals; zero where they face away, over 120 degrees apart.
Vec3 mean_normal(const Vec3& normal_a, const Vec3& normal_b) {
    const Vec3 n = normal_a - normal_b;
    const double length = n.norm();
    return length < 1.0 ? Vec3(Vec3::Zero()) : Vec3(n / length);
}

}  // namespace

double support(const SphereSurface& s, const Vec3& n) {
    const double corner = s.normal.dot(n) * corner_distance(s.radius, s.spread_cos);
    return s.spread_sin == 0.0 ? s.radius : std::max(s.radius, corner);
}

Vec3 support_point(const SphereSurface& s, const Vec3& n) {
    if (s.spread_sin == 0.0) return s.center + s.radius * n;
    return s.center + corner_distance(s.radius, s.spread_cos) * s.normal;
}

Gap measure_gap_centres(const SphereSurface& a, const SphereSurface& b) {
    const Vec3 d = b.center - a.center;
    const double length = d.norm();
    if (length == 0.0) return {Vec3::UnitZ(), 0.0, 0.0, true, false};
    return {d / length, length - (a.radius + b.radius), 0.0, true, true};
}

Gap measure_gap_surface(const SphereSurface& a, const SphereSurface& b, bool prefer_a) {
    const Vec3 d = b.center - a.center;
    const double length = d.norm();
    if (length == 0.0) return {Vec3::UnitZ(), 0.0, 0.0, true, false};
    const Vec3 u = d / length;

    const bool same = std::abs(a.spread_cos - b.spread_cos) <= kSameSpread;
    const bool a_flatter = same || a.spread_cos > b.spread_cos;
    Vec3 n;
    if (a.faces.count > 0 && b.faces.count > 0)
        n = parting_normal(a, b, d);
    else if (same && !prefer_a)
        n = mean_normal(nearest_normal(a, u), nearest_normal(b, -u));
    else
        n = a_flatter ? nearest_normal(a, u) : Vec3(-nearest_normal(b, -u));
    if (n.isZero(0.0)) return {u, 0.0, 0.0, true, false};
    const double along = n.dot(d);
    const double lateral_sq = std::max(d.squaredNorm() - along * along, 0.0);
    return {n, along - support(a, n) - support(b, -n), lateral_sq, a_flatter, along > 0.0};
}

}  // namespace ice
