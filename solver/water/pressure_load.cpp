// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/water/pressure_load.hpp"

#include "common/math/ordered_products.hpp"
#include "solver/water/cut_triangle.hpp"

namespace ice {

namespace {

using namespace reference;

// Corners of a part of a triangle and the pressure there.
struct Part {
    std::array<Vector, 3> p;
    std::array<double, 3> pressure;
};

// Places and pressures are linear on the triangle: the same shares of the edges give both.
Part tip_of(const Part& t, const Cut& cut) { return {on_tip(t.p, cut), on_tip(t.pressure, cut)}; }

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

}  // namespace

WaterLoad pressure_load(const Shape& shape, const Mat3& rotation, double height,
                        const std::function<double(const Vec3&)>& pressure) {
    const WaterPlane water(rotation, height);
    // A vertex belongs to some six triangles, an edge to two: the pressure there, a look-up in the
    // flow's table, is computed once.
    std::vector<double> at_place;
    for (const Vec3& vertex : shape.mesh.vertices) at_place.push_back(pressure(vertex));
    for (const Vec3& middle : shape.edges.middle) at_place.push_back(pressure(middle));
    Vector force{}, moment{};
    for (std::size_t n = 0; n < shape.mesh.triangles.size(); ++n) {
        const Quarters quarters(shape, water, n);
        if (!quarters.any_corner_wet()) continue;
        // (P1): the pressure is linear over each quarter
        const std::array<double, 6> value = quarters.points.pick(at_place);
        Sums sums;
        for (const Quarter& quarter : kQuarters)
            add_inside(
                quarters.cut_of(quarter),
                Part{Quarters::pick(quarters.p, quarter), Quarters::pick(value, quarter)},
                [](const Part& part) { return part; }, sums);
        // -a (p_1 + p_2 + p_3) / 3, and -(sum p sum r + sum p r) / 12 x a: the pressure pushes
        // inwards.
        force = force - (sums.force / 3.0) * quarters.area;
        moment = moment - cross((1.0 / 12.0) * sums.moment, quarters.area);
    }
    return {ordered_product(rotation, Vec3(force.x, force.y, force.z)),
            ordered_product(rotation, Vec3(moment.x, moment.y, moment.z))};
}

}  // namespace ice
