// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/narrow/feature/measure_gap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/narrow/feature/gap_rule.hpp"
#include "solver/shape/shape.hpp"

namespace ice {

namespace {

// The direction of d if it lies in the normal cone, else the cone's normal nearest to it.
Vec3 nearest_normal(const Feature& s, const Vec3& d) {
    if (s.spread_cos == 1.0) return s.normal;
    const double distance = d.norm();
    if (distance == 0.0) return s.normal;  // no direction: the pair will be invalid
    // On the rim of the normal cone, in the plane of d and the middle normal: cos s m + sin s
    // t, with t the unit vector across m towards d.
    Vec3 u = d / distance;
    const double along = u.dot(s.normal);
    if (along >= s.spread_cos) return u;
    const Vec3 across = u - along * s.normal;
    const double length = across.norm();
    if (length == 0.0) return s.normal;  // u points straight inwards: the pair will be invalid
    return s.spread_cos * s.normal + (s.spread_sin / length) * across;
}

// A candidate separating axis; attempt() keeps the one with the largest gap.
struct CandidateAxis {
    Vec3 normal = Vec3::Zero();  // zero where the solids do not face each other
    double gap = -std::numeric_limits<double>::infinity();
    std::int8_t edge_a = -1, edge_b = -1;  // of the normal across two edges; -1: a face's

    void attempt(const Vec3& n, const Vec3& between, int a, int b) {
        const double now = n.dot(between);
        if (now <= gap) return;
        *this = {n, now, static_cast<std::int8_t>(a), static_cast<std::int8_t>(b)};
    }
};

Vec3 tip_to_tip(const Feature& a, const Feature& b) {
    return support_point(b, -a.normal) - support_point(a, -b.normal);
}

// Calls visit(n, at, ka, kb) for the edge axes whose edges cross between their ends.
template <class Visit>
void for_each_across(const Feature& a, const Feature& b, const Visit& visit) {
    const Vec3 d = b.center - a.center, between = tip_to_tip(a, b);
    for (int ka = 0; ka < a.cone.edges(); ++ka)
        for (int kb = 0; kb < b.cone.edges(); ++kb) {
            const Vec3 ea = a.cone.edge(ka), eb = b.cone.edge(kb), across = ea.cross(eb);
            const double sine = across.norm();
            // no axis where edges are parallel, else the sense that points from a to b
            if (sine <= kParallel) continue;
            const Vec3 n = (across.dot(d) < 0.0 ? -1.0 : 1.0) / sine * across;
            if (n.dot(d) <= 0.0 || !a.cone.contains(n, kSlantOnEdge) ||
                !b.cone.contains(-n, kSlantOnEdge))
                continue;
            // An edge that ends at its vertex has no part beyond the apex: a crossing there is
            // not on it.
            const LineParameters at = closest_on_lines(Vec3::Zero(), ea, between, eb);
            if (a.cone.ends() && at.along_a < -kBeyond * a.radius) continue;
            if (b.cone.ends() && at.along_b < -kBeyond * b.radius) continue;
            visit(n, at, ka, kb);
        }
}

// The edge axis whose edges cross nearest to the two spheres, within both patch radii; zero where
// there is none.
CandidateAxis nearest_edge_axis(const Feature& a, const Feature& b) {
    const Vec3 between = tip_to_tip(a, b);
    CandidateAxis nearest;
    double least = std::numeric_limits<double>::infinity();
    for_each_across(a, b, [&](const Vec3& n, const LineParameters& at, int ka, int kb) {
        const double beside = distance_sq(at);
        if (beside >= least || !is_within_patches(at, a, b)) return;
        least = beside;
        nearest = {n, n.dot(between), static_cast<std::int8_t>(ka), static_cast<std::int8_t>(kb)};
    });
    return nearest;
}

// Of all face axes and edge axes the one with the largest gap.
CandidateAxis best_axis(const Feature& a, const Feature& b) {
    CandidateAxis best;
    const Vec3 d = b.center - a.center, between = tip_to_tip(a, b);
    // a face's normal is one of its own edge's or corner's
    for (int k = 0; k < a.cone.count; ++k) {
        const Vec3& n = a.cone.normal[static_cast<std::size_t>(k)];
        if (n.dot(d) > 0.0 && b.cone.contains(-n, kSlantOnEdge)) best.attempt(n, between, -1, -1);
    }
    for (int k = 0; k < b.cone.count; ++k) {
        const Vec3 n = -b.cone.normal[static_cast<std::size_t>(k)];
        if (n.dot(d) > 0.0 && a.cone.contains(n, kSlantOnEdge)) best.attempt(n, between, -1, -1);
    }
    for_each_across(a, b, [&](const Vec3& n, const LineParameters&, int ka, int kb) {
        best.attempt(n, between, ka, kb);
    });
    return best;
}

// Squared distance across n of the incident point from the footprint of an edge or vertex.
double distance_across(const Feature& s, const Vec3& n, const Vec3& incident) {
    return distance_from(footprint(s, n), s.radius, part_across(incident - s.center, n), 0.0);
}

// Midway between two faces' normals; zero where they face away, over 120 degrees apart.
Vec3 mean_normal(const Vec3& normal_a, const Vec3& normal_b) {
    const Vec3 n = normal_a - normal_b;
    const double length = n.norm();
    return length < 1.0 ? Vec3(Vec3::Zero()) : Vec3(n / length);
}

const Gap kNone{Vec3::UnitZ(), 0.0, 0.0, true, false};

bool meet_elsewhere(const Feature& a, const Feature& b, const CandidateAxis& p) {
    const Vec3 apart = tip_to_tip(a, b);
    return p.gap < 0.0 && (is_less_deep(a, b, apart, p.gap) || is_less_deep(b, a, -apart, p.gap));
}

Gap gap_across(const Feature& a, const Feature& b, const CandidateAxis& p) {
    const LineParameters at = closest_on_lines(support_point(a, p.normal), a.cone.edge(p.edge_a),
                                               support_point(b, -p.normal), b.cone.edge(p.edge_b));
    const bool same = std::abs(a.spread_cos - b.spread_cos) <= kSameSpread;
    return crossing_gap(p.normal, p.gap, at, same || a.spread_cos > b.spread_cos, p.edge_a,
                        p.edge_b);
}

// Two edges or vertices with known faces: the best axis, replaced by the nearest edge axis where
// the incident apex does not lie over the face, or where the crossing is deeper (measure_gap.hpp).
Gap measure_gap_of_edges(const Feature& a, const Feature& b) {
    const CandidateAxis best = best_axis(a, b);
    const Vec3& n = best.normal;
    if (n.isZero(0.0) || meet_elsewhere(a, b, best)) return kNone;
    if (best.edge_a >= 0) return gap_across(a, b, best);
    // Which apex lies over the other's face? That face is the reference, a's where both do.
    const double offset_a_sq = distance_across(a, n, support_point(b, -n));
    const double offset_b_sq = distance_across(b, n, support_point(a, n));
    const bool on_a = offset_a_sq <= offset_b_sq + kFlush * a.radius * a.radius;
    const bool over = on_a ? offset_a_sq <= a.patch_radius * a.patch_radius
                           : offset_b_sq <= b.patch_radius * b.patch_radius;
    // Where neither apex lies over a face the crossing of two edges decides. So it does where
    // it is deeper along nearly the same normal: edges that cross at a small angle.
    const CandidateAxis across = nearest_edge_axis(a, b);
    if (!across.normal.isZero(0.0) &&
        (!over || (across.gap < best.gap - kFlush * std::min(a.radius, b.radius) &&
                   across.normal.dot(n) > kSameFace)))
        return meet_elsewhere(a, b, across) ? kNone : gap_across(a, b, across);
    if (!over) return kNone;
    return {n, best.gap, on_a ? offset_a_sq : offset_b_sq, on_a, true};
}

}  // namespace

bool is_less_deep(const Feature& s, const Feature& other, const Vec3& apart, double gap) {
    const auto first = s.cone.normal.begin();
    return std::any_of(first, first + s.cone.count, [&](const Vec3& n) {
        return n.dot(apart) + other.cone.least_along(n, kAround * other.radius) >
               gap + kBeyond * s.radius;
    });
}

Vec3 support_point(const Feature& s, const Vec3& n) { return s.center + support_offset(s, n); }

LineParameters closest_on_lines(const Vec3& pa, const Vec3& ea, const Vec3& pb, const Vec3& eb) {
    const Vec3 between = pb - pa, across = ea.cross(eb);
    const double square = across.squaredNorm();
    const Vec3 a = eb.cross(across) / square, b = ea.cross(across) / square;
    return {a.dot(between), b.dot(between)};
}

Gap measure_gap_surface(const Feature& a, const Feature& b, bool prefer_reference_a) {
    if (a.cone.count > 0 && b.cone.count > 0) return measure_gap_of_edges(a, b);
    const Vec3 d = b.center - a.center;
    const bool same = std::abs(a.spread_cos - b.spread_cos) <= kSameSpread;
    const bool reference_is_a = same || a.spread_cos > b.spread_cos;
    // the reference's normal nearest to the line of centres; of two faces between floes the
    // mean
    const Vec3 n = same && !prefer_reference_a
                       ? mean_normal(nearest_normal(a, d), nearest_normal(b, -d))
                   : reference_is_a ? nearest_normal(a, d)
                                    : Vec3(-nearest_normal(b, -d));
    if (n.isZero(0.0) || n.dot(d) <= 0.0 || !belongs(a, n) || !belongs(b, -n)) return kNone;
    // equation (3), and the incident support point's distance from the reference across n
    const Vec3 point_a = support_point(a, n), point_b = support_point(b, -n);
    const Vec3 at =
        part_across(reference_is_a ? Vec3(point_b - a.center) : Vec3(point_a - b.center), n);
    return {n, n.dot(point_b - point_a), at.squaredNorm(), reference_is_a, true};
}

}  // namespace ice
