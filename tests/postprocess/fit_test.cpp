// SPDX-License-Identifier: GPL-3.0-or-later
// Coefficients fitted to resistances that were made from known ones.
//
// Tolerances: 1e-9 and 1e-8 are rounding of the sums, amplified by the columns' condition of some
// 1e3 and by the exponents; 1e-6 of a force is made of them, with a reserve.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "common/base/error.hpp"
#include "postprocess/fit/fit_spencer.hpp"
#include "postprocess/fit/fit_sweep.hpp"
#include "postprocess/report/evaluate_run.hpp"
#include "tests/postprocess/write_runs.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using namespace ice::fit;
using namespace ice::test;

namespace {

const SpencerCoefficients kTrue{"true", 0.62, 1.4, 0.9, 2.1, 1.3, true};
const HullDimensions kHull{95.0, 22.0, 8.0, 0.0, 0.0};

FitPoint make_point(double thickness, double speed, bool level, double half = std::nan("")) {
    const IceConditions ice{thickness, 0.1, 900.0, 1025.0, 9.81, speed, 5e5};
    FitPoint p;
    p.scales = spencer_scales(kHull, ice);
    const SpencerParts parts = spencer_resistance(kHull, ice, kTrue);
    p.resistance = level ? parts.total() : parts.broken_ice();
    p.half = half;
    p.level_ice = level;
    return p;
}

}  // namespace

TEST_CASE("exact resistances give their coefficients back", "[fit][analytic]") {
    std::vector<FitPoint> points;
    for (const double h : {0.5, 1.0})
        for (const double v : {0.05, 1.0, 2.0, 3.0}) {
            points.push_back(make_point(h, v, false));
            points.push_back(make_point(h, v, true));
        }
    const SpencerFit fit = fit_spencer(points);
    CHECK(fit.broken == 8);
    CHECK(fit.level == 8);
    CHECK(fit.exponent_fitted);
    REQUIRE(fit.breaking_fitted);
    // rounding of the sums, amplified by the columns' condition of some 1e3
    CHECK(fit.coefficients.buoyancy == Near(kTrue.buoyancy).epsilon(1e-9));
    CHECK(fit.coefficients.clearing == Near(kTrue.clearing).epsilon(1e-9));
    CHECK(fit.coefficients.clearing_exponent == Near(kTrue.clearing_exponent).epsilon(1e-8));
    CHECK(fit.coefficients.breaking == Near(kTrue.breaking).epsilon(1e-8));
    CHECK(fit.coefficients.breaking_exponent == Near(kTrue.breaking_exponent).epsilon(1e-8));
    CHECK(fit.residual < tolerance(1e-9));
    for (const FitPoint& p : points)
        CHECK(fitted_resistance(fit, p) == Near(p.resistance).epsilon(1e-9));
}

TEST_CASE("two speeds keep Jeong's exponent, one is refused, rest is a speed",
          "[fit][degenerate]") {
    SpencerCoefficients jeong = kTrue;
    jeong.clearing_exponent = SpencerCoefficients().clearing_exponent;
    std::vector<FitPoint> points{make_point(1.0, 0.0, false), make_point(1.0, 2.0, false)};
    points[1].resistance = jeong.buoyancy * points[1].scales.weight +
                           jeong.clearing * points[1].scales.inertia *
                               std::pow(points[1].scales.froude, -jeong.clearing_exponent);
    const SpencerFit fit = fit_spencer(points);
    CHECK_FALSE(fit.exponent_fitted);
    CHECK(fit.coefficients.buoyancy == Near(jeong.buoyancy));
    CHECK(fit.coefficients.clearing == Near(jeong.clearing));
    CHECK(std::isnan(fit.intervals.buoyancy));
    points[1] = points[0];
    CHECK_THROWS_WITH(fit_spencer(points), Catch::Contains("fewer than two speeds"));
    CHECK_THROWS_AS(fit_spencer({}), Error);
}

TEST_CASE("intervals of noisy resistances hold the truth 95 times of 100", "[fit][property]") {
    std::mt19937_64 random(1);
    std::normal_distribution<double> noise;
    const int trials = 400;
    int b = 0, c = 0, a = 0, blind = 0;
    for (int trial = 0; trial < trials; ++trial) {
        std::vector<FitPoint> points;
        for (const double v : {0.1, 0.6, 1.2, 1.8, 2.4, 3.0}) {
            points.push_back(make_point(1.0, v, false));
            FitPoint& p = points.back();
            p.half = 1.96 * 0.02 * p.resistance;
            p.resistance += 0.02 * p.resistance * noise(random);
        }
        const SpencerFit fit = fit_spencer(points);
        const auto holds = [](double value, double half, double truth) {
            return std::abs(value - truth) <= half ? 1 : 0;
        };
        b += holds(fit.coefficients.buoyancy, fit.intervals.buoyancy, kTrue.buoyancy);
        c += holds(fit.coefficients.clearing, fit.intervals.clearing, kTrue.clearing);
        a += holds(fit.coefficients.clearing_exponent, fit.intervals.clearing_exponent,
                   kTrue.clearing_exponent);
        for (FitPoint& p : points) p.half = std::nan("");
        const SpencerFit without = fit_spencer(points);
        blind += holds(without.coefficients.buoyancy, without.intervals.buoyancy, kTrue.buoyancy);
    }
    // 400 trials at 95 %: 380 +- 4.4; four deviations below. The intervals grow where chance makes
    // the misses large, so they hold the truth more often, never always
    for (const int held : {b, c, a}) {
        CHECK(held >= 362);
        CHECK(held < trials);
    }
    CHECK(blind >= 340);  // one relative error for all is not what unweighted squares assume
}

TEST_CASE("a sweep gives its coefficients, a file gives them to the formulas", "[fit]") {
    const TempFolder folder;
    IceConditions ice{1.0, 0.1, 900.0, 1025.0, 9.81, 0.0};
    for (const double speed : {0.05, 1.0, 2.0})
        for (const int seed : {1, 2}) {
            ice.speed = speed;
            const double r = spencer_resistance(kHull, ice, kTrue).broken_ice();
            const auto run = folder / fmt::format("u{}s{}", speed, seed);
            write_run(run, speed, 0.1, seed, r * (seed == 1 ? 0.99 : 1.01));
            Summary s = read_summary(run / "summary.json");
            s.ship.length = kHull.length;
            s.ship.breadth = kHull.breadth;
            s.ship.draught = kHull.draught;
            s.ship.speed_mean = speed;
            s.ice.thickness = ice.thickness;
            s.ice.density = ice.ice_density;
            s.ice.water_density = ice.water_density;
            s.ice.gravity = ice.gravity;
            write_bytes(run / "summary.json", summary_text(s));
        }
    const auto sweep = sweep::read_sweep(folder.path());
    const auto points = fit_points(sweep, sweep::make_points(sweep), std::nan(""));
    REQUIRE(points.size() == 3);
    const SpencerFit fit = fit_spencer(points);
    CHECK(fit.coefficients.buoyancy == Near(kTrue.buoyancy).epsilon(1e-8));
    CHECK(fit.coefficients.clearing_exponent == Near(kTrue.clearing_exponent).epsilon(1e-8));
    CHECK(fit.intervals.buoyancy > 0.0);
    CHECK(fit_warnings(sweep, fit).empty());
    CHECK_THAT(fit_text(fit, points), Catch::Contains("C_B    0.62 +-"));

    write_bytes(folder / "ours.toml", coefficients_text(fit.coefficients, fit.intervals, "test"));
    FormulaOptions options;
    options.spencer = read_coefficients(folder / "ours.toml");
    Summary s = *sweep.runs.back().summary;  // at 2 m/s
    report::evaluate_run(s, options);
    double broken = 0.0;
    for (const FormulaValue& f : s.formulas)
        if (f.part == "buoyancy + clearing") broken = f.value;
    CHECK(broken == Near(spencer_resistance(kHull, ice, kTrue).broken_ice()).epsilon(1e-6));
}
