// SPDX-License-Identifier: GPL-3.0-or-later
/// Products whose sums have a fixed order, so that scalar code and kernels give the same bits.
/// Results have the product of the arguments' units.
///
/// Eigen's order depends on the vectors that it was compiled for. This is its order on SSE2, with
/// which all results were made: the first two rows of a product with a matrix as (a + b) + c, the
/// last as a + (b + c). Products entry by entry have no order and stay Eigen's.
#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// a . b
inline double ordered_dot(const Vec3& a, const Vec3& b) {
    return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}

/// m x
inline Vec3 ordered_product(const Mat3& m, const Vec3& x) {
    return {(m(0, 0) * x[0] + m(0, 1) * x[1]) + m(0, 2) * x[2],
            (m(1, 0) * x[0] + m(1, 1) * x[1]) + m(1, 2) * x[2],
            m(2, 0) * x[0] + (m(2, 1) * x[1] + m(2, 2) * x[2])};
}

/// m^T x: all rows as (a + b) + c.
inline Vec3 ordered_transposed(const Mat3& m, const Vec3& x) {
    return {ordered_dot(m.col(0), x), ordered_dot(m.col(1), x), ordered_dot(m.col(2), x)};
}

/// a b, column by column
inline Mat3 ordered_product(const Mat3& a, const Mat3& b) {
    Mat3 out;
    for (int k = 0; k < 3; ++k) out.col(k) = ordered_product(a, Vec3(b.col(k)));
    return out;
}

/// In body axes a tensor t, in world axes r t r^T; the second product's sums as a + (b + c).
inline Mat3 ordered_turned(const Mat3& r, const Mat3& t) {
    const Mat3 half = ordered_product(r, t);
    Mat3 out;
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
            out(i, k) = half(i, 0) * r(k, 0) + (half(i, 1) * r(k, 1) + half(i, 2) * r(k, 2));
    return out;
}

/// In body axes t x with the vector x in world axes, in world axes again: r (t (r^T x)).
inline Vec3 ordered_turned(const Mat3& r, const Mat3& t, const Vec3& x) {
    return ordered_product(r, ordered_product(t, ordered_transposed(r, x)));
}

/// The rotation a after b (Hamilton's product); not normalised.
inline Eigen::Quaterniond ordered_product(const Eigen::Quaterniond& a,
                                          const Eigen::Quaterniond& b) {
    return {(a.w() * b.w() - a.y() * b.y()) - (a.z() * b.z() + a.x() * b.x()),
            (a.w() * b.x() + a.y() * b.z()) - (a.z() * b.y() - a.x() * b.w()),
            (a.w() * b.y() + a.y() * b.w()) + (a.z() * b.x() - a.x() * b.z()),
            (a.w() * b.z() - a.y() * b.x()) + (a.z() * b.w() + a.x() * b.y())};
}

/// q / |q|; zero stays zero.
inline Eigen::Quaterniond ordered_normalized(const Eigen::Quaterniond& q) {
    const double square = (q.x() * q.x() + q.z() * q.z()) + (q.y() * q.y() + q.w() * q.w());
    if (!(square > 0.0)) return q;
    const double length = std::sqrt(square);
    return {q.w() / length, q.x() / length, q.y() / length, q.z() / length};
}

}  // namespace ice
