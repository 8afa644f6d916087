// SPDX-License-Identifier: GPL-3.0-or-later
/// Triangles cut by a quantity that is even on them, one at a time: pieces of the scalar references
/// of the water's sums. facet_lanes-inl.hpp has them in lanes.
#pragma once

#include <array>
#include <cstddef>

#include "common/geometry/triangle_mesh.hpp"

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
};

/// Sums over the part of a triangle where the flow t.f comes from outside.
/// @param whole  sums over all of a triangle; those with the tip's geometry count by its share
/// @param tip_of the triangle at the apex that the cut leaves
template <class Sums, class Triangle, class Whole, class Tip>
Sums integrate_facing(const Triangle& t, const Whole& whole, const Tip& tip_of) {
    const Cut cut(t.f, {t.f[0] > 0.0, t.f[1] > 0.0, t.f[2] > 0.0});
    Sums out;
    if (cut.counts_whole()) out.add(1.0, whole(t));
    if (!cut.any) return out;
    const double size = cut.part(1) * cut.part(2);
    out.add(cut.tip_is_inside() ? size : -size, whole(tip_of(t, cut)));
    return out;
}

}  // namespace ice::reference
