// SPDX-License-Identifier: GPL-3.0-or-later
/// Triangles cut by a quantity that is even on them, one at a time: pieces of the scalar references
/// of the water's sums. facet_lanes-inl.hpp and quarters_lanes-inl.hpp have them in lanes.
#pragma once

#include <array>
#include <cstddef>

#include "solver/water/six_points.hpp"
#include "solver/water/wetted_sums.hpp"

namespace ice::reference {

// Sums in a fixed order: Eigen's depends on its vector width.
struct Vector {
    double x, y, z;
    friend Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend Vector operator*(double s, Vector a) { return {s * a.x, s * a.y, s * a.z}; }
};
inline Vector cross(Vector a, Vector b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double dot(Vector a, Vector b) { return (a.x * b.x + a.y * b.y) + a.z * b.z; }
inline Vector get(const Vec3& from) { return {from[0], from[1], from[2]}; }

// A height [m] at the water counts as wet: a facet in the surface has no height and so no load.
inline bool wet(double z) { return z <= 0.0; }

// How a quantity that is linear on a triangle cuts it at 0, from its values at the corners and
// which of these are inside. Where it does, `apex` is the corner alone on its side.
struct Cut {
    std::array<double, 3> value;
    std::array<bool, 3> inside;
    bool any = false;
    std::size_t apex = 2;

    Cut(const std::array<double, 3>& values, const std::array<bool, 3>& are_inside)
        : value(values), inside(are_inside) {
        const bool differ_01 = inside[0] != inside[1], differ_12 = inside[1] != inside[2];
        any = differ_01 || differ_12;
        if (differ_01) apex = differ_12 ? 1 : 0;
    }
    // share of the edge from the apex to the k-th corner after it that is on the apex' side
    double part(std::size_t k) const { return value[apex] / (value[apex] - value[(apex + k) % 3]); }
    bool tip_is_inside() const { return inside[apex]; }
    // Does the whole triangle count, with or without a tip?
    bool counts_whole() const { return any ? !tip_is_inside() : inside[0]; }
    // Share of the triangle's area that the tip has, negative where it is taken off the whole. The
    // tip is similar to the whole in the plane of the cut: its area is the product of the shares.
    double tip_size() const {
        const double size = part(1) * part(2);
        return tip_is_inside() ? size : -size;
    }
};

inline Cut cut_by_water(const std::array<double, 3>& heights) {
    return Cut(heights, {wet(heights[0]), wet(heights[1]), wet(heights[2])});
}

// A quantity that is linear on a triangle, from its values at the corners: at those of the part on
// the apex' side of the cut, the apex and the points in which the cut crosses its two edges.
template <class T>
std::array<T, 3> on_tip(const std::array<T, 3>& of, const Cut& cut) {
    const T &a = of[cut.apex], &b = of[(cut.apex + 1) % 3], &c = of[(cut.apex + 2) % 3];
    return {a, a + cut.part(1) * (b - a), a + cut.part(2) * (c - a)};
}

// Adds an integral over the part of a triangle that is inside: over the whole where most of it is,
// then over the tip (tip_of), added or taken off. So a triangle that the cut crosses changes
// continuously. @param integral  over the whole of a triangle, in units of its area
template <class Triangle, class Integral, class Sums>
void add_inside(const Cut& cut, const Triangle& t, const Integral& integral, Sums& sums) {
    if (cut.counts_whole()) sums.add(1.0, integral(t));
    if (cut.any) sums.add(cut.tip_size(), integral(tip_of(t, cut)));
}

// Integrates over the part of a triangle where the flow t.f comes from outside.
template <class Triangle>
auto integrate_part(const Triangle& t) {
    const Cut cut(t.f, {t.f[0] > 0.0, t.f[1] > 0.0, t.f[2] > 0.0});
    decltype(integrate_whole(t)) out;
    const auto whole = [](const Triangle& all) { return integrate_whole(all); };
    add_inside(cut, t, whole, out);
    return out;
}

// Adds integrate_part() of the wetted part. @param h  how the water cuts the triangle
template <class Triangle, class Sums>
void add_wetted(const Cut& h, const Triangle& t, Sums& sums) {
    const auto part = [](const Triangle& wetted) { return integrate_part(wetted); };
    add_inside(h, t, part, sums);
}

// A triangle's six points [m], their heights over the water [m], and the area [m2] of each quarter
// along the outward normal.
struct Quarters {
    SixPoints points;
    std::array<Vector, 6> p;
    std::array<double, 6> z;
    Vector area;

    Quarters(const Shape& shape, const WaterPlane& water, std::size_t triangle)
        : points(shape, triangle) {
        for (std::size_t k = 0; k < 6; ++k) {
            p[k] = get(points.at[k]);
            z[k] = dot(get(water.up), p[k]) + water.height;
        }
        const FacetBlock& block = shape.facets.blocks[triangle / FacetBlock::kLanes];
        const std::size_t lane = triangle % FacetBlock::kLanes;
        area = 0.25 * Vector{block.area[0][lane], block.area[1][lane], block.area[2][lane]};
    }
    // Without a wet corner the triangle is dry.
    bool any_corner_wet() const { return wet(z[0]) || wet(z[1]) || wet(z[2]); }
    Cut cut_of(const Quarter& q) const { return cut_by_water(pick(z, q)); }

    // Of values at the six points those at a quarter's corners.
    template <class T>
    static std::array<T, 3> pick(const std::array<T, 6>& of, const Quarter& q) {
        return {of[q[0]], of[q[1]], of[q[2]]};
    }
};

}  // namespace ice::reference
