// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/integrate/rotation.hpp"

#include "common/math/ordered_products.hpp"

namespace ice {

namespace {

// w(q) = R I^-1 R^T L [rad/s], (2): without torque L is constant and w is not.
Vec3 angular_velocity_at(const Eigen::Quaterniond& orientation, const Mat3& inverse_inertia_body,
                         const Vec3& angular_momentum) {
    return ordered_turned(orientation.toRotationMatrix(), inverse_inertia_body, angular_momentum);
}

}  // namespace

Eigen::Quaterniond exponential_map(const Vec3& angle) {
    Vec3 half = 0.5 * angle;
    int squarings = 0;
    // Large angles are halved until the series converges fast, and the result is squared as often:
    // exp(a) = exp(a / 2^k)^(2^k).
    while (ordered_dot(half, half) > RotationSeries::kLargest) {
        half *= 0.5;
        ++squarings;
    }
    // Horner in x^2
    const double x2 = ordered_dot(half, half);
    double sinc = 1.0, cosine = 1.0;
    // shorter series for small angles, as most floes turn by less in a step
    const RotationSeries& series = kRotationSeries;
    for (std::size_t k = x2 <= series.kSmall ? series.kFewTerms : series.kTerms; k >= 1; --k) {
        sinc = 1.0 - x2 * series.of_sinc[k] * sinc;
        cosine = 1.0 - x2 * series.of_cosine[k] * cosine;
    }
    Eigen::Quaterniond q(cosine, sinc * half.x(), sinc * half.y(), sinc * half.z());
    if (squarings == 0) return q;
    for (; squarings > 0; --squarings) q = ordered_product(q, q);
    return ordered_normalized(q);
}

Eigen::Quaterniond advance_orientation(const Eigen::Quaterniond& orientation,
                                       const Mat3& inverse_inertia_body,
                                       const Vec3& angular_momentum, double dt) {
    const auto turn_at = [&](const Eigen::Quaterniond& q) -> Vec3 {
        // k = dt w(q) of (18)
        return dt * angular_velocity_at(q, inverse_inertia_body, angular_momentum);
    };
    const auto turn = [&](const Vec3& angle) {
        return turn_at(ordered_product(exponential_map(angle), orientation));
    };
    // Equation (18). The commutators k x k correct for rotations that do not commute; without them
    // the method is of second order.
    const Vec3 k1 = turn_at(orientation);
    if (k1.isZero(0.0)) return orientation;
    const Vec3 k2 = turn(0.5 * k1);
    const Vec3 k3 = turn(0.5 * k2 - 0.125 * k1.cross(k2));
    const Vec3 k4 = turn(k3);
    const Vec3 whole = (k1 + 2.0 * k2 + 2.0 * k3 + k4 - 0.5 * k1.cross(k4)) / 6.0;
    return ordered_normalized(ordered_product(exponential_map(whole), orientation));
}

}  // namespace ice
