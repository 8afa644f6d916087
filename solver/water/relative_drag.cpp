// SPDX-License-Identifier: GPL-3.0-or-later
// The mathematics; relative_lanes-inl.hpp has several bodies in lanes, to the same bits.
#include "solver/water/relative_drag.hpp"

#include <algorithm>
#include <cmath>

#include "common/math/ordered_products.hpp"
#include "solver/water/cut_triangle.hpp"
#include "solver/water/wetted_sums.hpp"

namespace ice {

namespace {

using namespace reference;

// A triangle, the velocity relative to the water at its corners, and the flow through all of it if
// it were everywhere that at the corner [m3/s].
struct Triangle {
    std::array<Vector, 3> p, u;
    std::array<double, 3> f;
};

// The part on the apex' side of the cut, with the area of the whole.
Triangle tip_of(const Triangle& t, const Cut& cut) {
    const std::size_t a = cut.apex, b = (a + 1) % 3, c = (a + 2) % 3;
    const double s = cut.part(1), r = cut.part(2);
    return {{t.p[a], t.p[a] + s * (t.p[b] - t.p[a]), t.p[a] + r * (t.p[c] - t.p[a])},
            {t.u[a], t.u[a] + s * (t.u[b] - t.u[a]), t.u[a] + r * (t.u[c] - t.u[a])},
            {t.f[a], t.f[a] + s * (t.f[b] - t.f[a]), t.f[a] + r * (t.f[c] - t.f[a])}};
}

// 12, 60 and 60 times int f u, int f p x u and int f u . u.
struct Sums {
    Vector force{}, moment{};
    double loss = 0.0;

    void add(double factor, const Sums& m) {
        force = force + factor * m.force;
        moment = moment + factor * m.moment;
        loss = loss + factor * m.loss;
    }
};

// With the means of products of three shape functions over a triangle, 1/10 of one cubed, 1/30 of
// a square and another, 1/60 of all three: int f g h = 1/60 sum_k h_k e_k,
// e_k = F G + sum f g + F g_k + f_k G + 2 f_k g_k, sums over the corners in capitals.
Sums integrate_whole(const Triangle& t) {
    Sums out;
    const double flow = (t.f[0] + t.f[1]) + t.f[2];
    const auto weighted = [&](const std::array<Vector, 3>& g) {
        return (t.f[0] * g[0] + t.f[1] * g[1]) + t.f[2] * g[2];
    };
    const Vector sum_p = (t.p[0] + t.p[1]) + t.p[2], sum_u = (t.u[0] + t.u[1]) + t.u[2];
    const Vector base_p = flow * sum_p + weighted(t.p), base_u = flow * sum_u + weighted(t.u);
    out.force = base_u;
    for (std::size_t k = 0; k < 3; ++k) {
        const double own = flow + 2.0 * t.f[k];
        const Vector e_p = base_p + (own * t.p[k] + t.f[k] * sum_p);
        const Vector e_u = base_u + (own * t.u[k] + t.f[k] * sum_u);
        out.moment = out.moment + cross(e_p, t.u[k]);
        out.loss = out.loss + dot(e_u, t.u[k]);
    }
    return out;
}

// Over the part where the water comes from outside.
Sums integrate_part(const Triangle& t) {
    return integrate_facing<Sums>(
        t, [](const Triangle& all) { return integrate_whole(all); },
        [](const Triangle& all, const Cut& cut) { return tip_of(all, cut); });
}

// The body's velocity relative to the water, at points of the body.
class Relative {
public:
    Relative(const Vec3& v, const Vec3& w, const std::function<Vec3(const Vec3&)>& water)
        : v_(get(v)), w_(get(w)), water_(water) {}
    // u of (24): v + w x p less the water's velocity
    Vector at(const Vec3& p) const { return (v_ + cross(w_, get(p))) - get(water_(p)); }

private:
    Vector v_, w_;
    const std::function<Vec3(const Vec3&)>& water_;
};

// Over the wetted part of one quarter. @param z  heights of its corners over the water
void add_wetted(const Triangle& t, const std::array<double, 3>& z, Sums& sums) {
    const Cut h(z, {wet(z[0]), wet(z[1]), wet(z[2])});
    if (h.counts_whole()) sums.add(1.0, integrate_part(t));
    if (!h.any) return;
    const double size = h.part(1) * h.part(2);
    sums.add(h.tip_is_inside() ? size : -size, integrate_part(tip_of(t, h)));
}

// @param u  relative to the water: at the vertices and, numbered behind them, at the edges' middles
Sums integrate(const Shape& shape, const WaterPlane& plane, const std::vector<Vector>& u) {
    const auto height = [&](const Vec3& p) { return dot(get(plane.up), get(p)) + plane.height; };
    Sums sums;
    for (std::size_t n = 0; n < shape.mesh.triangles.size(); ++n) {
        std::array<std::size_t, 6> place;  // corners, then the middles of the edges behind them
        std::array<Vec3, 6> p;
        std::array<double, 6> z, f;
        for (std::size_t k = 0; k < 3; ++k) {
            place[k] = static_cast<std::size_t>(shape.mesh.triangles[n][k]);
            place[3 + k] = shape.mesh.vertices.size() +
                           static_cast<std::size_t>(shape.edges.of_triangle[n][k]);
            p[k] = shape.mesh.vertices[place[k]];
            z[k] = height(p[k]);
        }
        if (!wet(z[0]) && !wet(z[1]) && !wet(z[2])) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            p[3 + k] = 0.5 * (p[k] + p[(k + 1) % 3]);
            z[3 + k] = height(p[3 + k]);
        }
        const FacetBlock& block = shape.facets.blocks[n / FacetBlock::kLanes];
        const std::size_t lane = n % FacetBlock::kLanes;
        // (25): the flow is linear over the quarters that the edges' middles make of a triangle
        const Vector quarter =
            0.25 * Vector{block.area[0][lane], block.area[1][lane], block.area[2][lane]};
        for (std::size_t k = 0; k < 6; ++k) f[k] = dot(quarter, u[place[k]]);
        for (const auto& [a, b, c] : kQuarters)
            add_wetted({{get(p[a]), get(p[b]), get(p[c])},
                        {u[place[a]], u[place[b]], u[place[c]]},
                        {f[a], f[b], f[c]}},
                       {z[a], z[b], z[c]}, sums);
    }
    return sums;
}

}  // namespace

RelativeDrag relative_drag(const Shape& shape, const Motion& motion,
                           const std::function<Vec3(const Vec3&)>& water, double coefficient,
                           double water_density) {
    RelativeDrag out;
    const Relative relative(ordered_transposed(motion.rotation, motion.velocity),
                            ordered_transposed(motion.rotation, motion.angular_velocity), water);
    static thread_local std::vector<Vector> u;
    u.clear();
    for (const Vec3& vertex : shape.mesh.vertices) u.push_back(relative.at(vertex));
    for (const Vec3& middle : shape.edges.middle) u.push_back(relative.at(middle));
    const Sums sums = integrate(shape, WaterPlane(motion.rotation, motion.height), u);
    const double factor = -0.5 * water_density * coefficient;
    const Mat3 turn = factor * motion.rotation;
    const Vec3 force(sums.force.x / 12.0, sums.force.y / 12.0, sums.force.z / 12.0);
    const Vec3 moment(sums.moment.x / 60.0, sums.moment.y / 60.0, sums.moment.z / 60.0);
    out.force = ordered_product(turn, force);
    out.moment = ordered_product(turn, moment);
    out.loss = -factor * (sums.loss / 60.0);
    return out;
}

}  // namespace ice
