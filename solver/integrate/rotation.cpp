// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/integrate/rotation.hpp"

#include <array>

namespace ice {

namespace {

// Ratios of successive terms of the series over x^2: 1 / (2k (2k + 1)) and 1 / ((2k - 1) 2k).
struct Terms {
    std::array<double, 8> of_sinc{}, of_cosine{};
};
constexpr Terms kTerms = [] {
    Terms out;
    for (std::size_t k = 1; k < 8; ++k) {
        const double n = 2.0 * static_cast<double>(k);
        out.of_sinc[k] = 1.0 / (n * (n + 1.0));
        out.of_cosine[k] = 1.0 / ((n - 1.0) * n);
    }
    return out;
}();

Vec3 angular_velocity_at(const Eigen::Quaterniond& orientation, const Mat3& inverse_inertia_body,
                         const Vec3& angular_momentum) {
    const Mat3 r = orientation.toRotationMatrix();
    return r * (inverse_inertia_body * (r.transpose() * angular_momentum));
}

}  // namespace

Eigen::Quaterniond exponential_map(const Vec3& angle) {
    Vec3 half = 0.5 * angle;
    int squarings = 0;
    while (half.squaredNorm() > 0.25) {
        half *= 0.5;
        ++squarings;
    }
    // Horner in x^2; at |x| <= 1/2 the first terms left out, x^16/16! and x^16/17!, are below
    // 1e-18; at the angles of a step, x^2 <= 1e-3, already x^10/10! and x^10/11! are
    const double x2 = half.squaredNorm();
    double sinc = 1.0, cosine = 1.0;
    for (std::size_t k = x2 <= 1e-3 ? 4 : 7; k >= 1; --k) {
        sinc = 1.0 - x2 * kTerms.of_sinc[k] * sinc;
        cosine = 1.0 - x2 * kTerms.of_cosine[k] * cosine;
    }
    Eigen::Quaterniond q(cosine, sinc * half.x(), sinc * half.y(), sinc * half.z());
    if (squarings == 0) return q;
    for (; squarings > 0; --squarings) q = q * q;
    return q.normalized();
}

Eigen::Quaterniond advance_orientation(const Eigen::Quaterniond& orientation,
                                       const Mat3& inverse_inertia_body,
                                       const Vec3& angular_momentum, double dt) {
    const auto turn_at = [&](const Eigen::Quaterniond& q) -> Vec3 {
        return dt * angular_velocity_at(q, inverse_inertia_body, angular_momentum);
    };
    const auto turn = [&](const Vec3& angle) {
        return turn_at(exponential_map(angle) * orientation);
    };
    const Vec3 k1 = turn_at(orientation);
    if (k1.isZero(0.0)) return orientation;
    const Vec3 k2 = turn(0.5 * k1);
    const Vec3 k3 = turn(0.5 * k2 - 0.125 * k1.cross(k2));
    const Vec3 k4 = turn(k3);
    const Vec3 whole = (k1 + 2.0 * k2 + 2.0 * k3 + k4 - 0.5 * k1.cross(k4)) / 6.0;
    return (exponential_map(whole) * orientation).normalized();
}

}  // namespace ice
