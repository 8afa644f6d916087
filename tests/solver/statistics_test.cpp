// SPDX-License-Identifier: GPL-3.0-or-later
// The interval of a mean: exact where theory gives it, and its coverage on series whose mean is
// known. Every kind of series is drawn 200 times; 95 % are to be covered, 90 to 98 % may be: that
// is 3.2 standard deviations of a share of 0.95 among 200 below, and 1.9 above. A swing that the
// series holds a few times cannot be told from noise as slow, so there all 200 may be covered.
//
// Tolerances: 1e-12 to 1e-9 are rounding of sums of many thousand terms; 1e-6 that of a difference
// of them, or the last digit of t in a table.
#include "solver/record/statistics.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <random>

#include "solver/record/long_series.hpp"
#include "solver/record/periodogram.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;

namespace {

constexpr double kMean = 7.0;

using Random = std::mt19937;
using Series = std::vector<double>;

Series white(Random& random, std::size_t n) {
    std::normal_distribution<double> normal;
    Series x(n);
    for (double& value : x) value = kMean + normal(random);
    return x;
}

// x_t = rho x_{t-1} + white noise: sum of autocorrelations (1 + rho) / (1 - rho)
Series autoregression(Random& random, std::size_t n, double rho) {
    std::normal_distribution<double> normal;
    Series x(n);
    double state = normal(random) / std::sqrt(1.0 - rho * rho);
    for (double& value : x) {
        state = rho * state + normal(random);
        value = kMean + state;
    }
    return x;
}

// A period of random phase and length, as a row of floes gives it, on correlated noise.
Series periodic(Random& random, std::size_t n, double amplitude) {
    Series x = autoregression(random, n, 0.9);
    std::uniform_real_distribution<double> period(100.0, 200.0), phase(0.0, 1.0);
    const double p = period(random), f = phase(random);
    for (std::size_t t = 0; t < n; ++t)
        x[t] += amplitude * std::sin(2.0 * std::numbers::pi * (static_cast<double>(t) / p + f));
    return x;
}

// Shots that come at random, exponential in size, and fade with a time of 20 samples.
Series shots(Random& random, std::size_t n, double fade) {
    std::bernoulli_distribution hit(0.1);
    std::exponential_distribution<double> size;
    const double keep = fade > 0.0 ? std::exp(-1.0 / fade) : 0.0;
    Series x(n);
    double state = 0.1 / (1.0 - keep);
    const double mean = state;
    for (int t = -500; t < static_cast<int>(n); ++t) {
        state = keep * state + (hit(random) ? size(random) : 0.0);
        if (t >= 0) x[static_cast<std::size_t>(t)] = kMean + state - mean;
    }
    return x;
}

// White noise on a sine of half its deviation that the series holds `held` times.
Series swinging(Random& random, std::size_t n, double held) {
    Series x = white(random, n);
    const double phase = std::uniform_real_distribution<double>()(random);
    for (std::size_t t = 0; t < n; ++t)
        x[t] += 0.5 * std::sin(2.0 * std::numbers::pi *
                               (held * static_cast<double>(t) / static_cast<double>(n) + phase));
    return x;
}

// White noise on an autoregression of 0.3 times its deviation that fades over `time` samples.
Series drifting(Random& random, std::size_t n, double time) {
    Series x = white(random, n);
    const double rho = std::exp(-1.0 / time);
    const Series slow = autoregression(random, n, rho);
    for (std::size_t t = 0; t < n; ++t)
        x[t] += 0.3 * std::sqrt(1.0 - rho * rho) * (slow[t] - kMean);
    return x;
}

int covered_of_200(const std::function<Series(Random&)>& draw) {
    Random random(20261123);
    int covered = 0;
    for (int k = 0; k < 200; ++k) {
        const MeanInterval m = mean_interval(draw(random));
        covered += std::abs(m.mean - kMean) <= m.half_width;
    }
    return covered;
}

}  // namespace

TEST_CASE("the mean of a constant series is that constant, with no width", "[record][analytic]") {
    const MeanInterval m = mean_interval(Series(1000, 3.5));
    CHECK(m.mean == 3.5);
    CHECK(m.half_width == 0.0);
    CHECK(m.trend == 0.0);
    CHECK_FALSE(m.trend_significant);
}

TEST_CASE("a series too short for an interval has none, and an empty one no mean",
          "[record][analytic]") {
    CHECK(std::isnan(mean_interval(Series{}).mean));
    CHECK(std::isnan(mean_interval(Series{}).half_width));
    Random random(1);
    const MeanInterval few = mean_interval(white(random, 39));
    CHECK(std::isfinite(few.mean));
    CHECK(std::isnan(few.half_width));
    CHECK_FALSE(few.trend_significant);
    // one swing that the whole series does not see the end of
    Series swing(1000);
    for (std::size_t t = 0; t < swing.size(); ++t) swing[t] = t < 500 ? 1.0 : -1.0;
    const MeanInterval m = mean_interval(swing);
    CHECK((std::isnan(m.half_width) || m.half_width > 0.5));
}

TEST_CASE("white noise has the classical interval", "[record][analytic]") {
    Random random(5);
    double ratio = 0.0, samples = 0.0;
    for (int k = 0; k < 50; ++k) {
        const Series x = white(random, 2000);
        const MeanInterval m = mean_interval(x);
        const double classical = 1.961 * standard_deviation(x) / std::sqrt(2000.0);
        CHECK(m.half_width == Near(classical).epsilon(0.35));  // 3 sqrt(1 / (2 * 111)), J = 111
        ratio += m.half_width / classical / 50.0;
        samples += m.effective_samples / 2000.0 / 50.0;
    }
    CHECK(ratio == Near(1.0).epsilon(0.03));    // 3 sqrt(1 / (2 * 111 * 50)), 50 series
    CHECK(samples == Near(1.0).epsilon(0.06));  // as the width's square: twice that
}

TEST_CASE("the correlation time of an autoregression is (1 + rho) / (1 - rho)",
          "[record][analytic]") {
    Random random(6);
    for (const double rho : {0.5, 0.8, 0.95}) {
        CAPTURE(rho);
        const double expected = (1.0 + rho) / (1.0 - rho);
        double time = 0.0;
        for (int k = 0; k < 50; ++k)
            time += mean_interval(autoregression(random, 8000, rho)).correlation_time / 50.0;
        // J = 8000 / (30 tau) ordinates each, 50 series: 5 % of scatter at the most, three times
        CHECK(time == Near(expected).epsilon(0.15));
    }
}

TEST_CASE(
    "the 95 % interval covers the mean of white noise and autoregressions 90 to 98 times in "
    "100",
    "[record][property]") {
    for (const auto& [n, rho] : {std::pair(1000, 0.0), std::pair(1000, 0.5), std::pair(1000, 0.9),
                                 std::pair(2000, 0.98), std::pair(3000, 0.99)}) {
        const int covered = covered_of_200([n = n, rho = rho](Random& random) {
            return autoregression(random, static_cast<std::size_t>(n), rho);
        });
        CAPTURE(n, rho, covered);
        CHECK(covered >= 180);
        CHECK(covered <= 196);
    }
}

TEST_CASE("the 95 % interval covers the mean of periodic and of peaky series 90 to 98 times in 100",
          "[record][property]") {
    const auto check = [](const char* kind, const std::function<Series(Random&)>& draw) {
        const int covered = covered_of_200(draw);
        CAPTURE(kind, covered);
        CHECK(covered >= 180);
        CHECK(covered <= 196);
    };
    check("period on noise", [](Random& r) { return periodic(r, 1210, 3.0); });
    check("period on noise, longer", [](Random& r) { return periodic(r, 3000, 3.0); });
    check("fading shots", [](Random& r) { return shots(r, 2000, 20.0); });
    check("single shots", [](Random& r) { return shots(r, 4000, 0.0); });
}

TEST_CASE("the 95 % interval covers the mean 90 times in 100 where fast noise hides slow changes",
          "[record][property][long]") {
    for (const double held : {1.5, 2.5, 3.5, 5.5}) {
        const int covered =
            covered_of_200([=](Random& random) { return swinging(random, 2000, held); });
        CAPTURE(held, covered);
        CHECK(covered >= 180);
    }
    for (const double time : {50.0, 100.0, 200.0, 300.0}) {
        const int covered =
            covered_of_200([=](Random& random) { return drifting(random, 6000, time); });
        CAPTURE(time, covered);
        CHECK(covered >= 180);
        CHECK(covered <= 196);
    }
}

TEST_CASE("the half width of slow changes under fast noise is that of theory",
          "[record][analytic]") {
    // S = 1 + 0.09 (1 + rho) / (1 - rho), about 1 + 0.18 time
    Random random(14);
    double width = 0.0;
    for (int k = 0; k < 50; ++k) width += mean_interval(drifting(random, 6000, 100.0)).half_width;
    // 50 series, each of 4 ordinates or more: 5 % of scatter, and the few ordinates' Student's t
    CHECK(width / 50.0 == Near(1.96 * std::sqrt(19.0 / 6000.0)).epsilon(0.25));
}

TEST_CASE("correlation time and effective samples do not depend on how long the series is",
          "[record][analytic]") {
    Random random(13);
    for (const std::size_t n : {2000, 8192, 8193, 40000, 100000}) {
        CAPTURE(n);
        const MeanInterval m = mean_interval(white(random, n));
        // 3 standard deviations of the mean of J = n / 18 ordinates; blocks are 4096 or more
        const auto least = static_cast<double>(std::min<std::size_t>(n, 4096));  // blocks
        const double scatter = 3.0 / std::sqrt(least / 18.0);
        CHECK(m.correlation_time == Near(1.0).epsilon(scatter));
        CHECK(m.effective_samples == Near(static_cast<double>(n)).epsilon(scatter));
    }
}

TEST_CASE("a period that the series holds many times hardly widens the interval",
          "[record][property]") {
    // batches of a twentieth would each hold 0.6 of a period: their means scatter by its amplitude
    Random random(8);
    Series x = white(random, 1200);
    const double plain = mean_interval(x).half_width;
    for (std::size_t t = 0; t < x.size(); ++t)
        x[t] += 5.0 * std::sin(2.0 * std::numbers::pi * static_cast<double>(t) / 100.0);
    const MeanInterval m = mean_interval(x);
    CHECK(m.half_width < 2.0 * plain);
    CHECK(m.effective_samples > 1200.0);  // as of independent samples of that spread
}

TEST_CASE("a long series has the interval of its block means", "[record][property]") {
    Random random(9);
    const Series x = autoregression(random, 5 * 8192, 0.9);
    Series blocks;
    for (std::size_t b = 0; b < 8192; ++b) {
        blocks.push_back(0.0);
        for (std::size_t k = 0; k < 5; ++k) blocks.back() += x[5 * b + k] / 5.0;
    }
    const MeanInterval all = mean_interval(x), of_blocks = mean_interval(blocks);
    CHECK(all.half_width == Near(of_blocks.half_width).epsilon(1e-9));
    CHECK(all.trend == Near(of_blocks.trend).epsilon(1e-6));
    // and it is not far from theory, S = 1 / (1 - rho)^2: blocks have tau = 19 / 5, so that
    // J = 8192 / (30 tau) = 72, and 3 sqrt(1 / (2 J)) = 0.25
    CHECK(all.half_width == Near(1.96 * 10.0 / std::sqrt(5.0 * 8192)).epsilon(0.3));
}

TEST_CASE("a long series keeps few blocks, and the mean and deviation of all its values",
          "[record][property]") {
    Random random(5);
    const Series x = autoregression(random, 300000, 0.9);
    LongSeries all, most(LongSeries::Join::largest);
    for (std::size_t k = 0; k < x.size(); ++k) {
        all.add(x[k]);
        most.add(x[k]);
        if (k + 1 != LongSeries::kMost - 1) continue;
        // as long as it keeps single values it is the series
        const std::span<const double> so_far(x.data(), k + 1);
        const MeanInterval a = mean_interval(all), b = mean_interval(so_far);
        CHECK(a.mean == b.mean);
        CHECK(a.half_width == b.half_width);
        CHECK(a.correlation_time == b.correlation_time);
        CHECK(all.standard_deviation() == standard_deviation(so_far));
        CHECK(all.block_length() == 1);
    }
    const MeanInterval blocked = mean_interval(all), exact = mean_interval(x);
    CHECK(blocked.mean == exact.mean);  // the same sum
    CHECK(all.standard_deviation() == Near(standard_deviation(x)).epsilon(1e-12));
    CHECK(blocked.half_width == Near(exact.half_width).epsilon(0.05));
    CHECK(all.count() == x.size());
    CHECK(all.block_length() == 8);
    CHECK(all.blocks().size() == x.size() / 8);
    CHECK(most.blocks().size() == x.size() / 8);
    for (const std::size_t block : {std::size_t{0}, std::size_t{777}, x.size() / 8 - 1}) {
        const auto first = x.begin() + static_cast<std::ptrdiff_t>(8 * block);
        CHECK(all.blocks()[block] == Near(std::accumulate(first, first + 8, 0.0) / 8.0));
        CHECK(most.blocks()[block] == *std::max_element(first, first + 8));
    }
    CHECK(all.largest() == *std::max_element(x.begin(), x.end(), [](double l, double r) {
              return std::abs(l) < std::abs(r);
          }));
}

TEST_CASE("a trend is found in a series that has one, and seldom in one that has none",
          "[record][property]") {
    const auto found_of_200 = [](double rise, const std::function<Series(Random&)>& draw) {
        Random random(10);
        int found = 0;
        for (int k = 0; k < 200; ++k) {
            Series x = draw(random);
            const auto n = static_cast<double>(x.size());
            for (std::size_t t = 0; t < x.size(); ++t) x[t] += rise * static_cast<double>(t) / n;
            found += mean_interval(x).trend_significant.value_or(false);
        }
        return found;
    };
    const auto noise = [](Random& r) { return autoregression(r, 2000, 0.9); };
    const auto row = [](Random& r) { return periodic(r, 2000, 2.0); };
    const auto swing = [](Random& r) { return swinging(r, 2000, 2.5); };
    const auto drift = [](Random& r) { return drifting(r, 6000, 200.0); };
    // 1 % is meant: more than 7 of 200 have a chance of 0.001
    CHECK(found_of_200(0.0, noise) <= 7);
    CHECK(found_of_200(0.0, swing) <= 7);
    // lines and slow changes make it about 3 % (400 series): more than 12 have a chance of 0.01
    CHECK(found_of_200(0.0, row) <= 12);
    CHECK(found_of_200(0.0, drift) <= 12);
    // a rise of 8 is 10 standard deviations, sqrt(12 * 100 / 2000) each; Student's limit of the
    // narrowest band, 3 degrees, is 5.8 of them
    CHECK(found_of_200(8.0, noise) >= 190);
    CHECK(found_of_200(8.0, row) >= 190);
}

TEST_CASE("the rise of a straight line is exact", "[record][analytic]") {
    Series line(100);
    for (std::size_t t = 0; t < 100; ++t) line[t] = 3.0 * static_cast<double>(t);
    CHECK(mean_interval(line).trend == Near(300.0).epsilon(1e-12));
}

TEST_CASE("the periodogram's ordinates sum to the variance", "[record][analytic]") {
    Random random(12);
    Series x = white(random, 401);
    double mean = 0.0;
    for (const double value : x) mean += value / 401.0;
    double squares = 0.0;
    for (double& value : x) squares += (value -= mean, value * value);
    double sum = 0.0;
    for (const double ordinate : low_periodogram(x, 200)) sum += 2.0 * ordinate;
    CHECK(sum == Near(squares).epsilon(1e-10));  // Parseval
}

TEST_CASE("Student's interval of three values is that of the tables", "[record][analytic]") {
    const Series three{1.0, 2.0, 3.0};
    const MeanInterval m = student_interval(three);
    CHECK(m.mean == 2.0);
    CHECK(m.half_width == Near(4.302653 / std::sqrt(3.0)).epsilon(1e-6));  // t(0.975, 2), s = 1
    CHECK(std::isnan(student_interval(Series{1.0}).half_width));
}
