// SPDX-License-Identifier: GPL-3.0-or-later
/// Tolerances of the tests. The environment variable ICE_TOLERANCE_SCALE multiplies all of them;
/// with 0 every comparison that is not exact fails and prints its residual.
///
/// Each tolerance has its origin in a comment, beside it or at the top of its file: the rounding of
/// so many operations on numbers of a size, an error of the discretisation, the interval of a
/// statistic, the last digit of a published value.
#pragma once

#include <cmath>
#include <cstdlib>
#include <limits>
#include <ostream>
#include <type_traits>

namespace ice::test {

/// ICE_TOLERANCE_SCALE, 1 if it is not set.
inline double tolerance_scale() {
    const char* text = std::getenv("ICE_TOLERANCE_SCALE");
    return text == nullptr ? 1.0 : std::strtod(text, nullptr);
}

/// A bound on an error, scaled: CHECK((a - b).norm() < tolerance(1e-9)).
inline double tolerance(double value) { return value * tolerance_scale(); }

/// A number and how far another may be from it: CHECK(x == Near(2.0).epsilon(1e-12)). The larger of
/// two bounds holds: margin(), 0 unless given, and epsilon() of the number, kFormula unless either
/// is given. Catch's Approx keeps its own 1.2e-5 of the number beside a margin, which then bounds
/// nothing.
class Near {
public:
    /// Catch's default for Approx: a hundred times a float's rounding, 1.2e-5. It tells a formula
    /// from a wrong one. Roundings of a formula in double precision are far below it: 1e-16 of its
    /// largest term for each operation.
    static constexpr double kFormula =
        100.0 * static_cast<double>(std::numeric_limits<float>::epsilon());

    template <class T, class = std::enable_if_t<std::is_constructible_v<double, T>>>
    explicit Near(const T& expected) : expected_(static_cast<double>(expected)) {}

    /// As a share of |expected|.
    Near& epsilon(double share) {
        epsilon_ = share;
        bounded_ = true;
        return *this;
    }
    /// In the number's own unit.
    Near& margin(double absolute) {
        margin_ = absolute;
        if (!bounded_) epsilon_ = 0.0;
        return *this;
    }

    template <class T, class = std::enable_if_t<std::is_constructible_v<double, T>>>
    friend bool operator==(const T& got, const Near& near) {
        return near.allows(static_cast<double>(got));
    }

    /// The number, what is allowed, and how far out the last number was that was compared.
    friend std::ostream& operator<<(std::ostream& out, const Near& near) {
        const auto precision = out.precision(10);
        out << near.expected_;
        out.precision(3);
        out << " +- " << std::fmax(near.by_margin(), near.by_share()) << ", off by " << near.off_;
        out.precision(precision);
        return out;
    }

private:
    double by_margin() const { return tolerance(margin_); }
    double by_share() const {
        return tolerance(epsilon_) * (std::isinf(expected_) ? 0.0 : std::abs(expected_));
    }
    bool within(double got, double bound) const {
        return got + bound >= expected_ && expected_ + bound >= got;
    }
    bool allows(double got) const {
        off_ = std::abs(got - expected_);
        return within(got, by_margin()) || within(got, by_share());
    }

    double expected_;
    double epsilon_ = kFormula;
    double margin_ = 0.0;
    bool bounded_ = false;      // epsilon() was given
    mutable double off_ = 0.0;  // |got - expected| of the last comparison, for the message
};

}  // namespace ice::test
