// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/water/pressure_load.hpp"

#include "common/math/ordered_products.hpp"
#include "solver/water/cut_triangle.hpp"
#include "solver/water/relative_drag.hpp"
#include "solver/water/wetted_sums.hpp"

namespace ice {

namespace {

using namespace reference;

// Corners of a part of a triangle and the pressure there.
struct Part {
    std::array<Vector, 3> p;
    std::array<double, 3> pressure;
};

// Places and pressures are linear on the triangle: the same shares of the edges give both.
Part tip_of(const Part& t, const Cut& cut) {
    const std::size_t a = cut.apex, b = (a + 1) % 3, c = (a + 2) % 3;
    const double s = cut.part(1), r = cut.part(2);
    return {{t.p[a], t.p[a] + s * (t.p[b] - t.p[a]), t.p[a] + r * (t.p[c] - t.p[a])},
            {t.pressure[a], t.pressure[a] + s * (t.pressure[b] - t.pressure[a]),
             t.pressure[a] + r * (t.pressure[c] - t.pressure[a])}};
}

// 3 and 12 times int p dA and int p r dA, in units of the triangle's area.
struct Sums {
    double force = 0.0;
    Vector moment{};

    void add(double factor, const Part& t) {
        const double sum = (t.pressure[0] + t.pressure[1]) + t.pressure[2];
        const Vector corners = (t.p[0] + t.p[1]) + t.p[2];
        const Vector own =
            (t.pressure[0] * t.p[0] + t.pressure[1] * t.p[1]) + t.pressure[2] * t.p[2];
        force = force + factor * sum;
        moment = moment + factor * (sum * corners + own);
    }
};

// Over the wetted part. @param z  heights of its corners over the water
void add_wetted(const Part& t, const std::array<double, 3>& z, Sums& sums) {
    const Cut h(z, {wet(z[0]), wet(z[1]), wet(z[2])});
    if (h.counts_whole()) sums.add(1.0, t);
    if (!h.any) return;
    // The wetted part is the tip below the plane, or the whole less the tip above it. The tip has
    // this share of the triangle's area.
    const double size = h.part(1) * h.part(2);
    sums.add(h.tip_is_inside() ? size : -size, tip_of(t, h));
}

}  // namespace

WaterLoad pressure_load(const Shape& shape, const Mat3& rotation, double height,
                        const std::function<double(const Vec3&)>& pressure) {
    const WaterPlane plane(rotation, height);
    static thread_local std::vector<double> at_vertex;
    at_vertex.clear();
    // A vertex belongs to some six triangles: its pressure, a look-up in the flow's table, is
    // computed once.
    for (const Vec3& vertex : shape.mesh.vertices) at_vertex.push_back(pressure(vertex));
    Vector force{}, moment{};
    for (std::size_t n = 0; n < shape.mesh.triangles.size(); ++n) {
        const FacetBlock& block = shape.facets.blocks[n / FacetBlock::kLanes];
        // (P1): the pressure is linear over the quarters that the edges' middles make of a
        // triangle
        const std::size_t lane = n % FacetBlock::kLanes;
        const Vector quarter =
            0.25 * Vector{block.area[0][lane], block.area[1][lane], block.area[2][lane]};
        std::array<Vec3, 6> p;  // corners, then the middles of the edges behind them
        std::array<double, 6> z, value;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto corner = static_cast<std::size_t>(shape.mesh.triangles[n][k]);
            p[k] = shape.mesh.vertices[corner];
            value[k] = at_vertex[corner];
        }
        for (std::size_t k = 0; k < 3; ++k) {
            p[3 + k] = 0.5 * (p[k] + p[(k + 1) % 3]);
            value[3 + k] = pressure(p[3 + k]);
        }
        for (std::size_t k = 0; k < 6; ++k) z[k] = dot(get(plane.up), get(p[k])) + plane.height;
        Sums sums;
        for (const auto& [a, b, c] : kQuarters)
            add_wetted({{get(p[a]), get(p[b]), get(p[c])}, {value[a], value[b], value[c]}},
                       {z[a], z[b], z[c]}, sums);
        // -a (p_1 + p_2 + p_3) / 3, and -(sum p sum r + sum p r) / 12 x a: the pressure pushes
        // inwards.
        force = force - (sums.force / 3.0) * quarter;
        moment = moment - cross((1.0 / 12.0) * sums.moment, quarter);
    }
    return {ordered_product(rotation, Vec3(force.x, force.y, force.z)),
            ordered_product(rotation, Vec3(moment.x, moment.y, moment.z))};
}

}  // namespace ice
