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
    return {on_tip(t.p, cut), on_tip(t.u, cut), on_tip(t.f, cut)};
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

// @param u  relative to the water: at the vertices and, numbered behind them, at the edges' middles
Sums integrate(const Shape& shape, const WaterPlane& water, const std::vector<Vector>& u) {
    Sums sums;
    for (std::size_t n = 0; n < shape.mesh.triangles.size(); ++n) {
        const Quarters quarters(shape, water, n);
        if (!quarters.any_corner_wet()) continue;
        // (25): the flow is linear over each quarter
        const std::array<Vector, 6> at = quarters.points.pick(u);
        std::array<double, 6> f;
        for (std::size_t k = 0; k < 6; ++k) f[k] = dot(quarters.area, at[k]);
        for (const Quarter& quarter : kQuarters)
            add_wetted(quarters.cut_of(quarter),
                       Triangle{Quarters::pick(quarters.p, quarter), Quarters::pick(at, quarter),
                                Quarters::pick(f, quarter)},
                       sums);
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
    // A vertex belongs to some six triangles, an edge to two: the water's velocity there, a look-up
    // in the flow's table, is computed once.
    std::vector<Vector> u;
    for (const Vec3& vertex : shape.mesh.vertices) u.push_back(relative.at(vertex));
    for (const Vec3& middle : shape.edges.middle) u.push_back(relative.at(middle));
    const Sums sums = integrate(shape, WaterPlane(motion.rotation, motion.height), u);
    // (24): the factors of the exact integrals, and the turn to world axes, once for all triangles
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
