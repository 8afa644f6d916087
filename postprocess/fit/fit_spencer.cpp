// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/fit/fit_spencer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/base/error.hpp"
#include "common/base/least_squares.hpp"

namespace ice::fit {

namespace {

// Exponents a of (F3) that are tried before Newton's steps [-]: Jeong's is 1.157, and above 2
// clearing would fall with the speed. Coarser steps may begin in the valley of another minimum;
// finer ones only take time.
constexpr double kLeastExponent = -1.0, kMostExponent = 1.95, kExponentStep = 0.05;
// Froude numbers that differ by less are one speed, and logarithms of strength numbers that do not
// reach farther apart fix no exponent [-]. Rounding of speeds in cases is far below it.
constexpr double kSame = 1e-3;
// Newton's steps at most; the scan begins near the minimum, so a few suffice.
constexpr int kMostSteps = 50;

struct Problem {
    Eigen::VectorXd resistance, weight;  // of broken ice; weight: 1 / standard deviation
    std::vector<SpencerScales> scales;
    bool weighted = false;
};

double clearing(const SpencerScales& s, double exponent) {
    // at rest nothing is cleared, whatever the exponent
    return s.froude > 0.0 ? s.inertia * std::pow(s.froude, -exponent) : 0.0;
}

// Slopes of (F3), weighted, [points x columns]: dR / dC_B, dR / dC_C and, times C_C, dR / da [N].
Eigen::MatrixXd slopes(const Problem& p, double a, double c_c, int columns) {
    Eigen::MatrixXd out(p.resistance.size(), columns);
    for (Eigen::Index i = 0; i < out.rows(); ++i) {
        const SpencerScales& s = p.scales[static_cast<std::size_t>(i)];
        const double y = clearing(s, a);
        out(i, 0) = p.weight[i] * s.weight;
        out(i, 1) = p.weight[i] * y;
        if (columns > 2)
            out(i, 2) = s.froude > 0.0 ? -p.weight[i] * c_c * y * std::log(s.froude) : 0.0;
    }
    return out;
}

// C_B and C_C with the exponent a: for a given exponent the resistance is linear in both.
LeastSquares solve_at(const Problem& p, double a) {
    return solve_least_squares(slopes(p, a, 1.0, 2), p.weight.cwiseProduct(p.resistance));
}

// Gauss and Newton's steps from the best exponent of a scan; C_B and C_C follow it.
double find_exponent(const Problem& p) {
    double a = kLeastExponent, best = std::numeric_limits<double>::infinity();
    for (double tried = kLeastExponent; tried <= kMostExponent; tried += kExponentStep)
        if (const double chi2 = solve_at(p, tried).chi2; chi2 < best) {
            best = chi2;
            a = tried;
        }
    const Eigen::VectorXd right = p.weight.cwiseProduct(p.resistance);
    for (int k = 0; k < kMostSteps; ++k) {
        const LeastSquares now = solve_at(p, a);
        const Eigen::MatrixXd j = slopes(p, a, now.x[1], 3);
        const Eigen::VectorXd miss = right - j.leftCols(2) * now.x;
        double step = solve_least_squares(j, miss).x[2];
        // a step that makes the fit worse is halved: the exponent is not linear
        while (std::abs(step) > 1e-15 && solve_at(p, a + step).chi2 > now.chi2) step *= 0.5;
        // with an exponent above 2 clearing would fall with the speed
        if (!(std::abs(step) > 1e-14) || a + step > 2.0) break;
        a += step;
    }
    return a;
}

// Half widths of the 95 % intervals of the columns' coefficients, from the linearised problem.
Eigen::VectorXd half_widths(const Eigen::MatrixXd& j, double chi2, bool weighted) {
    const FitSpread spread = spread_of_fit(j, chi2, weighted);
    return spread.t * spread.covariance.diagonal().cwiseSqrt();
}

std::size_t count_speeds(const Problem& p) {
    std::vector<double> froude;
    for (const SpencerScales& s : p.scales) froude.push_back(s.froude);
    std::sort(froude.begin(), froude.end());
    std::size_t count = froude.empty() ? 0 : 1;
    for (std::size_t k = 1; k < froude.size(); ++k)
        if (froude[k] > froude[k - 1] * (1.0 + kSame)) ++count;
    return count;
}

Problem take_broken(const std::vector<FitPoint>& points) {
    Problem p;
    std::vector<double> resistance, weight;
    p.weighted = true;
    for (const FitPoint& point : points) {
        if (point.level_ice) continue;
        p.scales.push_back(point.scales);
        resistance.push_back(point.resistance);
        // 1 / standard deviation; the half width of a 95 % interval is 1.96 of them
        weight.push_back(kNormalHalfWidth / point.half);
        p.weighted = p.weighted && point.half > 0.0;  // false for NaN as well
    }
    const auto size = static_cast<Eigen::Index>(resistance.size());
    p.resistance = Eigen::Map<const Eigen::VectorXd>(resistance.data(), size);
    p.weight = p.weighted ? Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(weight.data(), size))
                          : Eigen::VectorXd::Ones(size);
    return p;
}

// C_BR and b of (F3): a line through the logarithm of level-ice resistance less buoyancy and
// clearing.
void fit_breaking(const std::vector<FitPoint>& points, SpencerFit& fit) {
    std::vector<double> x, y, weight;
    bool weighted = true;
    for (const FitPoint& point : points) {
        if (!point.level_ice) continue;
        ++fit.level;
        // The breaking part is the level-ice resistance less the fitted parts; a power law
        // is a line in its logarithm: log((R - R_B - R_C) / (rho_i B h V^2)) over log S. A point
        // where nothing is left has no logarithm and is passed over.
        const double left =
            point.resistance - fit.coefficients.buoyancy * point.scales.weight -
            fit.coefficients.clearing * clearing(point.scales, fit.coefficients.clearing_exponent);
        if (!(left > 0.0)) ++fit.level_below;
        if (!(left > 0.0) || !(point.scales.strength > 0.0)) continue;
        x.push_back(-std::log(point.scales.strength));
        y.push_back(std::log(left / point.scales.inertia));
        // the deviation of a logarithm is that of the value over the value
        weight.push_back(kNormalHalfWidth * left / point.half);
        weighted = weighted && point.half > 0.0;
    }
    const auto n = static_cast<Eigen::Index>(x.size());
    fit.level_used = x.size();
    if (n < 2) return;
    const auto [low, high] = std::minmax_element(x.begin(), x.end());
    // All points at one strength number fix no exponent.
    if (*high - *low < kSame) return;
    Eigen::MatrixXd j(n, 2);
    Eigen::VectorXd right(n);
    for (Eigen::Index i = 0; i < n; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const double w = weighted ? weight[k] : 1.0;
        j.row(i) << w, w * x[k];
        right[i] = w * y[k];
    }
    const LeastSquares line = solve_least_squares(j, right);
    const Eigen::VectorXd half = half_widths(j, line.chi2, weighted);
    fit.coefficients.breaking = std::exp(line.x[0]);
    fit.coefficients.breaking_exponent = line.x[1];
    // and back: the deviation of C_BR is C_BR times that of its logarithm
    fit.intervals.breaking = fit.coefficients.breaking * half[0];
    fit.intervals.breaking_exponent = half[1];
    fit.breaking_fitted = true;
}

// One speed gives a sum of both parts only, and they grow differently with the speed. Level ice has
// a third part, which is fitted after them.
void refuse_few_speeds(std::size_t speeds, std::size_t level) {
    constexpr const char* kNeeds = "C_B and C_C follow from broken ice at two speeds or more";
    if (speeds == 0)
        throw bad_input(
            "the sweep",
            fmt::format("has no run in broken ice, only {} point{} in level ice; {}", level,
                        level == 1 ? "" : "s", kNeeds),
            "put runs of the same ship in broken or pre-sawn ice into the same folder, beside "
            "those in level ice: three speeds or more, one of them creeping");
    if (speeds == 1)
        throw bad_input("the sweep", fmt::format("has broken ice at one speed only; {}", kNeeds),
                        "add runs in broken ice at other speeds, one of them creeping");
}

}  // namespace

double fitted_resistance(const SpencerFit& fit, const FitPoint& point) {
    const SpencerCoefficients& c = fit.coefficients;
    const SpencerScales& s = point.scales;
    double out = c.buoyancy * s.weight + c.clearing * clearing(s, c.clearing_exponent);
    if (point.level_ice && s.strength > 0.0)
        out += c.breaking * s.inertia * std::pow(s.strength, -c.breaking_exponent);
    return out;
}

SpencerFit fit_spencer(const std::vector<FitPoint>& points) {
    const Problem problem = take_broken(points);
    if (points.empty())
        throw bad_input("the sweep",
                        "has no run in 3D that states ship, ice and water (older programs did not)",
                        "run its cases again");
    const std::size_t speeds = count_speeds(problem);
    refuse_few_speeds(speeds, points.size() - problem.scales.size());
    SpencerFit fit;
    fit.coefficients.own = true;
    fit.broken = problem.scales.size();
    // Two speeds determine C_B and C_C alone; the exponent needs a third and is Jeong's otherwise.
    fit.exponent_fitted = speeds > 2;
    if (fit.exponent_fitted) fit.coefficients.clearing_exponent = find_exponent(problem);
    const double a = fit.coefficients.clearing_exponent;
    const LeastSquares best = solve_at(problem, a);
    fit.coefficients.buoyancy = best.x[0];
    fit.coefficients.clearing = best.x[1];
    const Eigen::VectorXd half = half_widths(
        slopes(problem, a, best.x[1], fit.exponent_fitted ? 3 : 2), best.chi2, problem.weighted);
    fit.intervals.buoyancy = half[0];
    fit.intervals.clearing = half[1];
    if (fit.exponent_fitted) fit.intervals.clearing_exponent = half[2];
    // After the parts of broken ice, which it subtracts.
    fit_breaking(points, fit);
    // root mean square of the relative deviations: slow and fast points count alike
    double squares = 0.0, count = 0.0;
    for (const FitPoint& point : points) {
        if (point.level_ice && !fit.breaking_fitted) continue;
        const double miss = fitted_resistance(fit, point) / point.resistance - 1.0;
        squares += miss * miss;
        ++count;
    }
    fit.residual = std::sqrt(squares / count);
    return fit;
}

}  // namespace ice::fit
