// SPDX-License-Identifier: GPL-3.0-or-later
// Integrals over a floe's wetted surface, (14) to (17): the definition, one facet at a time.
// wetted_sums_simd.cpp and facing_sums_simd.cpp compute the same bits in lanes.
#include <array>

#include "solver/water/cut_triangle.hpp"
#include "solver/water/drag.hpp"
#include "solver/water/wetted_sums.hpp"

namespace ice::reference {

namespace {

constexpr std::size_t kLanes = FacetBlock::kLanes;

using reference::get;
Vector get(const double (&from)[3][kLanes], std::size_t lane) {
    return {from[0][lane], from[1][lane], from[2][lane]};
}

// A sum for each lane of the blocks, then over the lanes.
using Sum = std::array<double, kLanes>;
double total(const Sum& s) {
    return ((s[0] + s[1]) + (s[2] + s[3])) + ((s[4] + s[5]) + (s[6] + s[7]));
}
struct VectorSum {
    Sum x{}, y{}, z{};

    void add(Vector v, std::size_t lane) {
        x[lane] += v.x;
        y[lane] += v.y;
        z[lane] += v.z;
    }
    Vec3 totals() const { return {total(x), total(y), total(z)}; }
};

Cut cut_of(const FacetBlock& block, std::size_t lane, const WaterPlane& water) {
    std::array<double, 3> z;
    for (std::size_t k = 0; k < 3; ++k)
        z[k] = dot(get(water.up), get(block.corner[k], lane)) + water.height;
    return cut_by_water(z);
}

// (16) needs no integral over the wetted part: the flow is even, so the wetted share will do.
double share_of(const FacetBlock& block, std::size_t lane, const WaterPlane& water) {
    const Cut h = cut_of(block, lane, water);
    return ice::wetted_share(h.value[0], h.value[1], h.value[2]);
}

// A triangle, and the flow through all of it if it were everywhere that at the corner [m3/s].
struct Triangle {
    std::array<Vector, 3> p;
    std::array<double, 3> f;
};
Triangle make_triangle(const FacetBlock& block, std::size_t lane, const Vec3& v, const Vec3& w) {
    const Vector area = get(block.area, lane);
    const Vector turning = cross(area, get(w));
    // f = a . (v + w x p) at the corners: linear over the triangle, so its integrals are exact
    const double even = dot(area, get(v));
    Triangle out;
    for (std::size_t k = 0; k < 3; ++k) {
        out.p[k] = get(block.corner[k], lane);
        out.f[k] = even + dot(turning, out.p[k]);
    }
    return out;
}
// The part on the apex' side of the cut, with the area of the whole.
Triangle tip_of(const Triangle& t, const Cut& cut) { return {on_tip(t.p, cut), on_tip(t.f, cut)}; }

// 3, 12 and 60 times the integrals.
struct Facing {
    double flow = 0.0;
    Vector first{}, square{}, mixed{};

    void add(double factor, const Facing& m) {
        flow = flow + factor * m.flow;
        first = first + factor * m.first;
        square = square + factor * m.square;
        mixed = mixed + factor * m.mixed;
    }
};

// Integrals of products of linear functions over a triangle by their corners' values: exact, with
// the factors 1/3, 1/12 and 1/60 taken out (wetted_sums.hpp).
Facing integrate_whole(const Triangle& t) {
    Facing out;
    out.flow = (t.f[0] + t.f[1]) + t.f[2];
    const Vector sum = (t.p[0] + t.p[1]) + t.p[2];
    const Vector g = (t.f[0] * t.p[0] + t.f[1] * t.p[1]) + t.f[2] * t.p[2];
    // Sums of the form (sum f)(sum p) + sum f p: twelve times the integral of f p, f and p linear.
    out.first = out.flow * sum + g;
    Vector e[3];
    for (std::size_t k = 0; k < 3; ++k) e[k] = (out.flow + 2.0 * t.f[k]) * t.p[k];
    const auto second = [&](double Vector::*i, double Vector::*j) {
        return ((out.first.*i * (sum.*j) + sum.*i * (g.*j)) +
                (t.p[0].*i * (e[0].*j) + t.p[1].*i * (e[1].*j))) +
               t.p[2].*i * (e[2].*j);
    };
    out.square = {second(&Vector::x, &Vector::x), second(&Vector::y, &Vector::y),
                  second(&Vector::z, &Vector::z)};
    out.mixed = {second(&Vector::x, &Vector::y), second(&Vector::x, &Vector::z),
                 second(&Vector::y, &Vector::z)};
    return out;
}

}  // namespace

WettedIntegrals integrate_wetted(const FacetBlocks& facets, const WaterPlane& water) {
    WettedIntegrals out;
    Sum volume{};
    VectorSum first;
    for (const FacetBlock& block : facets.blocks)
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            const Cut h = cut_of(block, lane, water);
            const auto& z = h.value;
            for (const bool is_wet : h.inside) (is_wet ? out.any_wet : out.any_dry) = true;
            const double area = dot(get(water.up), get(block.area, lane));
            const Vector corner[3] = {get(block.corner[0], lane), get(block.corner[1], lane),
                                      get(block.corner[2], lane)};
            // Equations (14) and (15): the whole triangle if most of it is wet, then its tip is
            // added or taken off. So a triangle that the water crosses changes continuously.
            if (h.counts_whole()) {
                const double sum = (z[0] + z[1]) + z[2];
                const Vector products = (z[0] * corner[0] + z[1] * corner[1]) + z[2] * corner[2];
                volume[lane] += area * sum;
                first.add(area * (sum * ((corner[0] + corner[1]) + corner[2]) + products), lane);
            }
            if (h.any) {
                const Vector p = corner[h.apex];
                const Vector q = corner[(h.apex + 1) % 3], r = corner[(h.apex + 2) % 3];
                const double s = h.part(1), t = h.part(2);
                const double tip = (s * t) * (area * z[h.apex]);
                const double sign = h.tip_is_inside() ? 1.0 : -1.0;
                // the corners' sum, and the apex once more: only its z is not 0
                const Vector sum = 4.0 * p + (s * (q - p) + t * (r - p));
                volume[lane] += sign * tip;
                first.add((sign * tip) * sum, lane);
            }
        }
    out.volume = total(volume) / 3.0;
    out.first = first.totals() / 12.0;
    return out;
}

FacingIntegrals integrate_facing(const FacetBlocks& facets, const WaterPlane& water, const Vec3& v,
                                 const Vec3& w) {
    std::array<Facing, kLanes> sums{};
    for (const FacetBlock& block : facets.blocks)
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            const Triangle t = make_triangle(block, lane, v, w);
            add_wetted(cut_of(block, lane, water), t, sums[lane]);
        }
    Sum flow{};
    VectorSum first, square, mixed;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        flow[lane] = sums[lane].flow;
        first.add(sums[lane].first, lane);
        square.add(sums[lane].square, lane);
        mixed.add(sums[lane].mixed, lane);
    }
    // The factors of exact integrals of polynomials over a triangle; kept out of the loop to save a
    // product for each triangle.
    return {total(flow) / 3.0, first.totals() / 12.0, square.totals() / 60.0,
            mixed.totals() / 60.0};
}

double integrate_facing(const FacetBlocks& facets, const WaterPlane& water, const Vec3& v) {
    Sum sum{};
    for (const FacetBlock& block : facets.blocks)
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            // (16): facets that face the flow, as far as they are wet
            const double facing = dot(get(block.area, lane), get(v));
            if (facing <= 0.0) continue;
            sum[lane] += facing * share_of(block, lane, water);
        }
    return total(sum);
}

}  // namespace ice::reference
