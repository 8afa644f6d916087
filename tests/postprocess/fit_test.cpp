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
    CHECK_THROWS_WITH(fit_spencer(points), Catch::Contains("broken ice at one speed only"));
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

namespace {

// A run folder of kHull at a speed in 1 m of ice, broken or level, whose resistance is `factor`
// times the formula's.
void write_fit_run(const std::filesystem::path& run, double speed, bool level, int seed,
                   double factor, const SpencerCoefficients& c = kTrue) {
    const IceConditions ice{1.0, 0.1, 900.0, 1025.0, 9.81, speed, 5e5};
    const SpencerParts parts = spencer_resistance(kHull, ice, c);
    const std::string more = level ? "[level_ice]\nthickness = 1.0\nextent = [0, 300, -60, 60]\n"
                                   : "[floes]\nfile = \"field.h5\"\nhold = \"never\"\n";
    write_run(run, speed, 0.1, seed, factor * (level ? parts.total() : parts.broken_ice()), more);
    Summary s = read_summary(run / "summary.json");
    s.warnings.clear();
    s.ship.length = kHull.length;
    s.ship.breadth = kHull.breadth;
    s.ship.draught = kHull.draught;
    s.ship.speed_mean = speed;
    s.ice.thickness = ice.thickness;
    s.ice.density = ice.ice_density;
    s.ice.water_density = ice.water_density;
    s.ice.gravity = ice.gravity;
    s.ice.hold = {level ? "until-bent" : "never"};
    if (level) s.ice.flexural_strength = ice.flexural_strength;
    write_bytes(run / "summary.json", summary_text(s));
}

// both kinds of ice at each speed, two seeds that differ by 2 % of the mean
void write_fit_folder(const TempFolder& folder, const std::vector<double>& speeds,
                      const SpencerCoefficients& c = kTrue) {
    for (const double speed : speeds)
        for (const int seed : {1, 2})
            for (const bool level : {false, true})
                write_fit_run(folder / fmt::format("{}u{}s{}", level ? "l" : "b", speed, seed),
                              speed, level, seed, seed == 1 ? 0.99 : 1.01, c);
}

struct FolderFit {
    sweep::Sweep sweep;
    std::vector<FitPoint> points;
    SpencerFit fit;
    std::string warnings;  // a line each
};

FolderFit fit_folder(const std::filesystem::path& folder) {
    FolderFit out{sweep::read_sweep(folder), {}, {}, ""};
    out.points = fit_points(out.sweep, sweep::make_points(out.sweep), std::nan(""));
    out.fit = fit_spencer(out.points);
    for (const std::string& w : fit_warnings(out.sweep, out.fit)) out.warnings += w + "\n";
    return out;
}

}  // namespace

TEST_CASE("a folder of runs in broken and in level ice gives all five coefficients", "[fit]") {
    const TempFolder folder;
    write_fit_folder(folder, {0.05, 1.0, 2.0, 3.0});
    const FolderFit f = fit_folder(folder.path());
    REQUIRE(f.points.size() == 8);
    CHECK(f.fit.broken == 4);
    CHECK(f.fit.level == 4);
    CHECK(f.fit.level_used == 4);
    CHECK(f.fit.coefficients.buoyancy == Near(kTrue.buoyancy).epsilon(1e-8));
    CHECK(f.fit.coefficients.clearing == Near(kTrue.clearing).epsilon(1e-8));
    CHECK(f.fit.coefficients.breaking == Near(kTrue.breaking).epsilon(1e-8));
    CHECK(f.fit.coefficients.breaking_exponent == Near(kTrue.breaking_exponent).epsilon(1e-8));
    // the ice of level_ice and floes differs between the kinds; that is no other axis
    CHECK_THAT(f.warnings, !Catch::Contains("varies between the runs"));
    CHECK_THAT(fit_text(f.fit, f.points),
               Catch::Contains("4 points of broken ice, 4 of level ice") &&
                   Catch::Contains("  broken\n") && Catch::Contains("  level\n"));
    // the friction is an input that the formula does not have, whichever kind of ice it is of
    write_run(folder / "other", 1.0, 0.2, 1, 1e5);
    CHECK_THAT(fit_folder(folder.path()).warnings,
               Catch::Contains("contact.friction_ship_ice varies between the runs"));
}

TEST_CASE("level ice alone is refused for want of broken ice, not of speeds", "[fit][degenerate]") {
    const TempFolder folder;
    for (const double speed : {1.0, 2.0, 3.0})
        write_fit_run(folder / fmt::format("u{}", speed), speed, true, 1, 1.0);
    const std::string text = error_text([&] { fit_folder(folder.path()); });
    CHECK_THAT(text, Catch::Contains("no run in broken ice, only 3 points in level ice") &&
                         Catch::Contains("into the same folder"));
    CHECK_THAT(text, !Catch::Contains("fewer"));
    write_fit_run(folder / "broken", 1.0, false, 1, 1.0);
    CHECK_THAT(error_text([&] { fit_folder(folder.path()); }),
               Catch::Contains("broken ice at one speed only"));
}

TEST_CASE("a fit warns of what its coefficients are worth", "[fit]") {
    SECTION("as many unknowns as points") {
        const TempFolder folder;
        write_fit_folder(folder, {1.0, 2.0});
        const std::string text = fit_folder(folder.path()).warnings;
        CHECK_THAT(text, Catch::Contains("2 points of broken ice for 2 coefficients"));
        CHECK_THAT(text, Catch::Contains("2 points of level ice for 2 coefficients"));
        const TempFolder more;
        write_fit_folder(more, {0.5, 1.0, 2.0, 3.0});
        CHECK_THAT(fit_folder(more.path()).warnings, !Catch::Contains("points of"));
    }
    SECTION("a negative coefficient, which the reader of the file refuses") {
        const TempFolder folder;
        SpencerCoefficients c = kTrue;
        c.clearing = -0.2;  // resistance that falls with the speed
        write_fit_folder(folder, {0.1, 1.0, 2.0}, c);
        const FolderFit f = fit_folder(folder.path());
        CHECK_THAT(f.warnings, Catch::Contains("C_C = -0.2") && Catch::Contains("is negative"));
        write_bytes(folder / "c.toml",
                    coefficients_text(f.fit.coefficients, f.fit.intervals, "test"));
        CHECK_THROWS_WITH(read_coefficients(folder / "c.toml"), Catch::Contains("spencer.c_c"));
    }
    SECTION("an interval that contains 0") {
        const TempFolder folder;
        SpencerCoefficients c = kTrue;
        c.clearing = 0.002;
        write_fit_folder(folder, {0.1, 1.0, 2.0}, c);
        CHECK_THAT(fit_folder(folder.path()).warnings,
                   Catch::Contains("C_C = ") && Catch::Contains("is not determined"));
    }
    SECTION("runs whose mean is affected, by how much") {
        const TempFolder folder;
        write_fit_folder(folder, {0.05, 1.0, 2.0, 3.0});
        Summary s = read_summary(folder / "bu1s1/summary.json");
        s.warnings = {{"short averages", true, 0.38}};
        write_bytes(folder / "bu1s1/summary.json", summary_text(s));
        CHECK_THAT(fit_folder(folder.path()).warnings,
                   Catch::Contains("1 of 16 completed runs has warnings that affect its mean, by "
                                   "up to 38 %: the coefficients"));
    }
}

TEST_CASE("a sweep gives its coefficients, a file gives them to the formulas", "[fit]") {
    const TempFolder folder;
    for (const double speed : {0.05, 1.0, 2.0, 3.0})
        for (const int seed : {1, 2})
            write_fit_run(folder / fmt::format("u{}s{}", speed, seed), speed, false, seed,
                          seed == 1 ? 0.99 : 1.01);
    const auto sweep = sweep::read_sweep(folder.path());
    const auto points = fit_points(sweep, sweep::make_points(sweep), std::nan(""));
    REQUIRE(points.size() == 4);
    const SpencerFit fit = fit_spencer(points);
    CHECK(fit.coefficients.buoyancy == Near(kTrue.buoyancy).epsilon(1e-8));
    CHECK(fit.coefficients.clearing_exponent == Near(kTrue.clearing_exponent).epsilon(1e-8));
    CHECK(fit.intervals.buoyancy > 0.0);
    CHECK(fit_warnings(sweep, fit).empty());
    CHECK_THAT(fit_text(fit, points), Catch::Contains("C_B    0.62 +-"));

    write_bytes(folder / "ours.toml", coefficients_text(fit.coefficients, fit.intervals, "test"));
    FormulaOptions options;
    options.spencer = read_coefficients(folder / "ours.toml");
    Summary s = *sweep.runs.back().summary;  // at 3 m/s
    const IceConditions ice{1.0, 0.1, 900.0, 1025.0, 9.81, 3.0, 5e5};
    report::evaluate_run(s, options);
    double broken = 0.0;
    for (const FormulaValue& f : s.formulas)
        if (f.part == "buoyancy + clearing") broken = f.value;
    CHECK(broken == Near(spencer_resistance(kHull, ice, kTrue).broken_ice()).epsilon(1e-6));
}
