// SPDX-License-Identifier: GPL-3.0-or-later
/// The rotation of a body in a step: docs/method.md, section 7.
#pragma once

#include <Eigen/Geometry>
#include <array>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// Taylor series of sin(x)/x and cos(x): ratios of successive terms over x^2, 1 / (2k (2k + 1)) and
/// 1 / ((2k - 1) 2k) for k = 1 ... kTerms. At |x| <= 1/2 the first terms left out, x^16/16! and
/// x^16/17!, are below 1e-18; at the angles of a step, x^2 <= kSmall [rad2], already x^10/10! and
/// x^10/11! are, and kFewTerms do. Fewer terms lose digits, more cost time alone.
struct RotationSeries {
    static constexpr std::size_t kTerms = 7, kFewTerms = 4;
    static constexpr double kSmall = 1e-3;
    /// Beyond this square of half the angle [rad2], an angle of 1 rad, angles are halved first.
    /// Smaller squares more results, which adds their rounding; larger needs more terms.
    static constexpr double kLargest = 0.25;
    std::array<double, kTerms + 1> of_sinc{}, of_cosine{};
};
inline constexpr RotationSeries kRotationSeries = [] {
    RotationSeries out;
    for (std::size_t k = 1; k <= RotationSeries::kTerms; ++k) {
        const double n = 2.0 * static_cast<double>(k);
        out.of_sinc[k] = 1.0 / (n * (n + 1.0));
        out.of_cosine[k] = 1.0 / ((n - 1.0) * n);
    }
    return out;
}();

/// Unit quaternion of a rotation vector [rad]: (cos |a|/2, sin(|a|/2) a/|a|).
///
/// Sine and cosine by their Taylor series, so that the bits do not depend on the system's libm;
/// angles beyond 1 rad are halved first and the result squared. Exact and of length 1 to rounding.
/// Zero gives the identity.
Eigen::Quaterniond exponential_map(const Vec3& angle);

/// Orientation after dt of torque-free rotation with constant angular momentum L (world axes).
///
/// The exponential map with angular velocities w(q) = R(q) I^-1 R(q)^T L at the start, twice at the
/// middle and at the end, combined to fourth order (Munthe-Kaas, Applied Numerical Mathematics 29,
/// 1999):
///
///     k1 = dt w(q),                        k2 = dt w(exp(k1/2) q),
///     k3 = dt w(exp(k2/2 - k1 x k2/8) q),  k4 = dt w(exp(k3) q),
///     q' = exp((k1 + 2 k2 + 2 k3 + k4 - k1 x k4 / 2) / 6) q
///
/// Why not the midpoint alone: near the unstable middle axis of a 1 x 0.8 x 0.3 m floe its energy
/// error reaches 1.3e-4 at |w| dt = 0.05; this stays below the required 1e-6 (motion_test.cpp).
///
/// @param orientation           body to world, unit; so is the result, to rounding
/// @param inverse_inertia_body  I^-1, body axes [1/(kg m2)]
/// @param angular_momentum      L, world axes [kg m2/s]; zero keeps the orientation
/// @param dt                    [s]
Eigen::Quaterniond advance_orientation(const Eigen::Quaterniond& orientation,
                                       const Mat3& inverse_inertia_body,
                                       const Vec3& angular_momentum, double dt);

}  // namespace ice
