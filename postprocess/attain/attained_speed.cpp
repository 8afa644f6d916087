// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/attain/attained_speed.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/base/assert.hpp"
#include "common/base/least_squares.hpp"

namespace ice::attain {

namespace {

// Largest speed at which a root is sought [m/s], for thrusts without an end: about 97 kn, above any
// ship.
constexpr double kMostSpeed = 50.0;
// Steps of the search from rest to that speed, 0.025 m/s each, and halvings of the step with the
// root. Two roots within one step are missed; 60 halvings reach the last digit of a double.
constexpr int kSteps = 2000, kHalvings = 60;

struct Trial {
    ResistanceFit fit;
    double misses = 0.0;  // chi^2 per degree of freedom [-]; 0 without any
};

Trial try_degree(const std::vector<SpeedPoint>& points, Eigen::Index degree, bool weighted) {
    const auto n = static_cast<Eigen::Index>(points.size());
    Eigen::MatrixXd j(n, degree + 1);
    Eigen::VectorXd right(n);
    for (Eigen::Index i = 0; i < n; ++i) {
        const SpeedPoint& p = points[static_cast<std::size_t>(i)];
        // 1 / standard deviation: the half width of a 95 % interval is 1.96 of them
        const double weight = weighted ? kNormalHalfWidth / p.half : 1.0;
        for (Eigen::Index k = 0; k <= degree; ++k)
            j(i, k) = weight * std::pow(p.speed, static_cast<double>(k));
        right[i] = weight * p.resistance;
    }
    Trial out;
    const LeastSquares solved = solve_least_squares(j, right);
    const FitSpread spread = spread_of_fit(j, solved.chi2, weighted);
    out.fit.coefficient = solved.x;
    out.misses = spread.scatter;
    out.fit.covariance = spread.covariance;
    out.fit.t = spread.t;
    return out;
}

// First root of a function that begins above 0; NaN without one.
double first_root(const std::function<double(double)>& f, double end) {
    // not even at rest does the thrust overcome the ice
    if (!(f(0.0) > 0.0)) return 0.0;
    // the lowest of several roots: a ship that speeds up stops there
    double low = 0.0;
    for (int k = 1; k <= kSteps; ++k) {
        double high = end * k / kSteps;
        if (f(high) > 0.0) {
            low = high;
            continue;
        }
        for (int half = 0; half < kHalvings; ++half) {
            const double middle = 0.5 * (low + high);
            (f(middle) > 0.0 ? low : high) = middle;
        }
        return 0.5 * (low + high);
    }
    return std::nan("");
}

}  // namespace

double ResistanceFit::at(double speed) const {
    // Horner's rule
    double sum = 0.0;
    for (Eigen::Index k = coefficient.size() - 1; k >= 0; --k) sum = sum * speed + coefficient[k];
    return sum;
}

double ResistanceFit::half(double speed) const {
    // variance of the curve at this speed: x . C x with x = (1, u, u^2)
    Eigen::VectorXd x(coefficient.size());
    for (Eigen::Index k = 0; k < x.size(); ++k) x[k] = std::pow(speed, static_cast<double>(k));
    return t * std::sqrt(x.dot(covariance * x));
}

ResistanceFit fit_resistance(const std::vector<SpeedPoint>& points) {
    ICE_ASSERT(std::any_of(points.begin(), points.end(),
                           [&](const SpeedPoint& p) { return p.speed != points.front().speed; }));
    const bool weighted =
        std::all_of(points.begin(), points.end(), [](const SpeedPoint& p) { return p.half > 0.0; });
    Trial best = try_degree(points, 1, weighted);
    // A parabola through three points has no deviation left to judge it by; four leave one degree
    // of freedom. Higher degrees swing between the points and are not tried.
    if (points.size() >= 4) {
        const Trial curved = try_degree(points, 2, weighted);
        // A parabola misses by less by chance, too: it must halve the line's chi^2 per degree of
        // freedom. A line at 1 or below already lies within the points' intervals.
        const bool straight = weighted && best.misses <= 1.0;
        if (!straight && curved.misses < 0.5 * best.misses) best = curved;
    }
    best.fit.slowest = best.fit.fastest = points.front().speed;
    for (const SpeedPoint& p : points) {
        best.fit.slowest = std::min(best.fit.slowest, p.speed);
        best.fit.fastest = std::max(best.fit.fastest, p.speed);
    }
    return best.fit;
}

double attained_speed(const std::function<double(double)>& resistance, const Thrust& thrust) {
    // beyond its own speeds a thrust has none
    const double end = std::min(thrust.fastest(), kMostSpeed);
    return first_root([&](double u) { return thrust.at(u) - resistance(u); }, end);
}

AttainedSpeed attained_speed(const ResistanceFit& fit, const Thrust& thrust) {
    // the ends of the interval: against the upper curve the ship is slower, against the lower
    // one faster
    const auto meets = [&](double halves) {
        return attained_speed([&](double u) { return fit.at(u) + halves * fit.half(u); }, thrust);
    };
    AttainedSpeed out;
    out.speed = attained_speed([&](double u) { return fit.at(u); }, thrust);
    out.low = std::isfinite(fit.t) ? meets(1.0) : std::nan("");
    out.high = std::isfinite(fit.t) ? meets(-1.0) : std::nan("");
    if (std::isnan(out.speed))
        out.reach = Reach::beyond;
    else if (out.speed == 0.0)
        out.reach = Reach::stuck;
    else
        out.reach =
            out.speed < fit.slowest || out.speed > fit.fastest ? Reach::outside : Reach::within;
    return out;
}

}  // namespace ice::attain
