// SPDX-License-Identifier: GPL-3.0-or-later
/// Logarithm and angle with the same bits on every machine: those of libraries differ with the
/// instruction set (fused products). Errors are some units in the last place. The lanes of
/// panel_sums_simd.cpp do the same operations in the same order.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace ice::own {

constexpr double kSqrt2 = std::numbers::sqrt2;
constexpr double kLn2 = std::numbers::ln2;
// The format of a double: 52 bits of mantissa, and an exponent that is stored with 1023 added.
// Other values give wrong logarithms.
constexpr std::uint64_t kMantissa = (std::uint64_t{1} << 52) - 1;  // mask of its bits
constexpr std::uint64_t kOne = std::uint64_t{1023} << 52;          // bits of 1.0
constexpr std::uint64_t kTwo52 = std::uint64_t{1023 + 52} << 52;   // bits of 2^52
// 2^52 + 1023 [-]. With a stored exponent as its last bits, 2^52 becomes 2^52 + 1023 + exponent.
constexpr double kTwo52AndBias = 4503599627370496.0 + 1023.0;

// Terms [-] of 1 / (2 k + 1): atanh's series, and with turns of sign atan's. The next term is below
// 1e-17 of the sum where |t| <= 0.199, to which both are reduced. Fewer terms lose digits, more
// cost time.
constexpr int kTerms = 11;

/// atanh(t) / t from t^2 [-], for |t| <= 0.199; atan(t) / t from -t^2.
inline double atanh_series(double square) {
    double sum = 1.0 / (2 * kTerms - 1);
    for (int k = kTerms - 2; k >= 0; --k) sum = sum * square + 1.0 / (2 * k + 1);
    return sum;
}

/// ln x [-] of a normal number x > 0: x = 2^e m with 1/sqrt 2 < m <= sqrt 2, and
/// ln m = 2 atanh((m - 1) / (m + 1)).
inline double log(double x) {
    const auto bits = std::bit_cast<std::uint64_t>(x);
    double exponent = std::bit_cast<double>((bits >> 52) | kTwo52) - kTwo52AndBias;
    double m = std::bit_cast<double>((bits & kMantissa) | kOne);
    const bool large = m > kSqrt2;
    m = large ? 0.5 * m : m;
    exponent = large ? exponent + 1.0 : exponent;
    const double t = (m - 1.0) / (m + 1.0);
    return exponent * kLn2 + 2.0 * t * atanh_series(t * t);
}

// Angles (2 k + 1) pi / 16 in the middle of four equal parts of the right angle, and tan of the
// parts' bounds k pi / 8.
constexpr std::array<double, 4> kMiddle{std::numbers::pi / 16, 3 * std::numbers::pi / 16,
                                        5 * std::numbers::pi / 16, 7 * std::numbers::pi / 16};
constexpr std::array<double, 4> kCos{0.98078528040323044913, 0.83146961230254523708,
                                     0.55557023301960222474, 0.19509032201612826785};
constexpr std::array<double, 4> kSin{0.19509032201612826785, 0.55557023301960222474,
                                     0.83146961230254523708, 0.98078528040323044913};
constexpr std::array<double, 3> kBound{0.41421356237309504880, 1.0, 2.41421356237309504880};

// Divisor instead of 0, where a point lies in a corner: the angle is then the middle one of a part,
// and no not-a-number.
constexpr double kLeast = 1e-300;

/// Angle of (x, y) in the quarter x, y >= 0 [rad]; in [0, pi / 2].
inline double quarter_angle(double y, double x) {
    const int part = (y > kBound[0] * x ? 1 : 0) + (y > x ? 1 : 0) + (y > kBound[2] * x ? 1 : 0);
    const auto k = static_cast<std::size_t>(part);
    const double up = y * kCos[k] - x * kSin[k], down = x * kCos[k] + y * kSin[k];
    const double t = up / (down > kLeast ? down : kLeast);
    return kMiddle[k] + t * atanh_series(-(t * t));
}

/// atan2(y, x) for y >= 0 [rad]; in [0, pi]. It is twice the angle of (r + x, y), or where that
/// loses digits of (y, r - x).
inline double half_plane_angle(double y, double x) {
    const double r = std::sqrt(x * x + y * y);
    const bool ahead = x >= 0.0;
    return 2.0 * quarter_angle(ahead ? y : r - x, ahead ? r + x : y);
}

}  // namespace ice::own
