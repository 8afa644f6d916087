// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/measure_gap.hpp"

#include <algorithm>
#include <cmath>

#include "solver/shape/shape.hpp"

namespace ice {

namespace {

// Spreads closer than this (in cosine) count as equally flat: normals are stored as floats.
constexpr double kSameSpread = 1e-6;

// The direction of the sphere's cap nearest to the unit vector u: u itself inside the cone of
// normals, else the normal turned towards u by the half-angle.
Vec3 nearest_normal(const SphereSurface& s, const Vec3& u) {
    const double along = u.dot(s.normal);
    if (s.spread_sin == 0.0) return s.normal;
    if (along >= s.spread_cos) return u;
    const Vec3 across = u - along * s.normal;
    const double length = across.norm();
    if (length == 0.0) return s.normal;  // u points straight inwards: the pair will be invalid
    return s.spread_cos * s.normal + (s.spread_sin / length) * across;
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
    const bool a_flatter = same ? prefer_a : a.spread_cos > b.spread_cos;
    Vec3 n;
    if (same && !prefer_a) {
        n = nearest_normal(a, u) - nearest_normal(b, -u);
        const double norm = n.norm();
        if (norm < 1.0)
            return {u, 0.0, 0.0, true, false};  // the surfaces face away: over 120 degrees
        n /= norm;
    } else {
        n = a_flatter ? nearest_normal(a, u) : Vec3(-nearest_normal(b, -u));
    }
    const double along = n.dot(d);
    const double lateral_sq = std::max(d.squaredNorm() - along * along, 0.0);
    return {n, along - support(a, n) - support(b, -n), lateral_sq, same || a_flatter, along > 0.0};
}

}  // namespace ice
