// SPDX-License-Identifier: GPL-3.0-or-later
// What a run warns of, and the verdict on the mean that each warning carries.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "solver/record/residual_impulse.hpp"
#include "solver/record/run_statistics.hpp"
#include "solver/step/step.hpp"
#include "tests/support/make_worlds.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;

namespace {

StatisticsOptions options(bool rigid = false) { return {{"bow"}, 1.005, rigid, 0.05, 4.0}; }

// A step that slows the ship by `force` [N].
StepRecord step_of(double force) {
    StepRecord r;
    r.contacts = 1;
    r.impulse = 2.0;
    r.contact_force = Vec3(-force, 0, 0);
    return r;
}

// 100 steps before the averaged time and 1000 in it, forces 90 and 110 N in turn
template <class Change>
Summary summary_of(RunStatistics statistics, const Change& change,
                   const TravelParticulars& travel = {}, double separation_work = -6.0) {
    for (int k = 0; k < 1100; ++k) {
        StepRecord r = step_of(k % 2 == 0 ? 90.0 : 110.0);
        const std::optional<double> residual = change(k - 100, r);
        statistics.add(r, 0.01 * (k + 1), 0.01, residual);
    }
    Summary s;
    s.travel = travel;
    s.energy["ship_work_J"] = 1000.0;
    s.energy["separation_J"] = separation_work;
    statistics.fill(s);
    return s;
}

constexpr auto kNothing = std::optional<double>();

}  // namespace

TEST_CASE("a run without a fault warns of nothing", "[record]") {
    const Summary s =
        summary_of(RunStatistics(options()), [](int, StepRecord&) { return kNothing; });
    CHECK(s.warnings.empty());
    CHECK(s.resistance.mean == Near(100.0));
    CHECK(s.residual_share == 0.0);
}

TEST_CASE("unconverged steps are warned of when they owe more than 2 % of the impulses",
          "[record][analytic]") {
    const auto owing = [](double residual) {
        return summary_of(RunStatistics(options()), [=](int k, StepRecord&) {
            return k % 2 == 0 ? std::optional(residual) : std::nullopt;
        });
    };
    const Summary little = owing(0.04);  // of every other step's 2 N s: 1 %
    CHECK(little.residual_share == Near(0.01));
    CHECK(little.unconverged_steps == 550);
    CHECK(little.warnings.empty());
    const Summary much = owing(0.2);
    REQUIRE(much.warnings.size() == 1);
    CHECK_THAT(much.warnings[0].text,
               Catch::Contains("550 of 1100 steps did not reach contact.tolerance"));
    CHECK(much.warnings[0].affects_mean == true);
    CHECK(much.warnings[0].share.value() == Near(0.05));
}

TEST_CASE("a jam's share of the mean is what the mean loses without its steps",
          "[record][analytic]") {
    const auto jammed = [](double force, int from) {
        return summary_of(RunStatistics(options(true)), [=](int k, StepRecord& r) {
            if (k < from || k >= from + 10) return kNothing;
            r.contact_force.x() = -force;
            r.jammed_contacts = 1;
            r.jammed_floe = 7;
            return kNothing;
        });
    };
    const Summary s = jammed(5000.0, 500);
    const double mean = (990 * 100.0 + 10 * 5000.0) / 1000.0;
    CHECK(s.resistance.mean == Near(mean));
    REQUIRE_FALSE(s.warnings.empty());
    CHECK_THAT(s.warnings[0].text, Catch::Contains("jam: in 10 of 1100 steps") &&
                                       Catch::Contains("first floe 7 at t = 6.01 s"));
    CHECK(s.warnings[0].affects_mean == true);
    CHECK(s.warnings[0].share.value() == Near((mean - 100.0) / mean));
    CHECK(jammed(200.0, 500).warnings.empty());    // 1 % of the mean
    CHECK(jammed(50000.0, -50).warnings.empty());  // before the averaged time
}

TEST_CASE("a deep overlap is warned of where opening overlaps put in much of the ship's work",
          "[record][analytic]") {
    const auto put_in = [](double work) {  // of the ship's 1000 J
        return summary_of(
            RunStatistics(options()),
            [](int k, StepRecord& r) {
                r.max_overlap = k == 300 ? 0.06 : 0.04;
                return kNothing;
            },
            {}, -work);
    };
    const Summary much = put_in(50.0);
    REQUIRE(much.warnings.size() == 1);
    CHECK_THAT(much.warnings[0].text, Catch::Contains("overlap reached 60.0 mm at t = 4.01 s"));
    CHECK(much.warnings[0].affects_mean == true);
    CHECK(much.warnings[0].share.value() == Near(0.05));
    const Summary little = put_in(6.0);
    CHECK(little.warnings.empty());
    CHECK(little.max_overlap == 0.06);  // the report's figure
}

TEST_CASE("a mean that few hits decide is warned of, with their share", "[record][analytic]") {
    const Summary s = summary_of(RunStatistics(options()), [](int k, StepRecord& r) {
        if (k % 200 == 0 && k >= 0) r.contact_force.x() = -50000.0;
        return kNothing;
    });
    REQUIRE(s.warnings.size() == 1);
    CHECK_THAT(s.warnings[0].text,
               Catch::Contains("1 % of the steps carry 72 % of the force along x"));
    CHECK(s.warnings[0].affects_mean == true);
    CHECK(s.warnings[0].share.value() ==
          Near((5 * 50000.0 + 5 * 110.0) / (995 * 100.0 + 5 * 50000.0)).epsilon(1e-3));
    CHECK_THAT(with_verdict(s.warnings[0]), Catch::Contains("affects the mean resistance"));
}

TEST_CASE("a resistance that rises over the averaged time is warned of with its share",
          "[record][analytic]") {
    const Summary s = summary_of(RunStatistics(options()), [](int k, StepRecord& r) {
        r.contact_force.x() -= 0.05 * (k - 499.5);  // 50 N over 1000 steps, mean as before
        return kNothing;
    });
    CHECK(s.resistance.trend == Near(50.0).epsilon(0.01));
    CHECK(s.resistance.trend_significant == true);
    REQUIRE(s.warnings.size() == 1);
    CHECK_THAT(s.warnings[0].text, Catch::Contains("rises by 50 % of its mean"));
    CHECK(s.warnings[0].affects_mean == true);
    CHECK(s.warnings[0].share.value() == Near(0.25).epsilon(0.01));  // of its end, half the rise
}

TEST_CASE("averages over less than a length are warned of with the interval's share of the mean",
          "[record][analytic]") {
    // 100 N and white noise, of whose 1000 samples the mean is known to 2 noise / sqrt(1000)
    const auto after = [](double lengths, double noise = 10.0) {
        std::mt19937 generator(1);
        std::normal_distribution<double> sample(100.0, noise);
        return summary_of(RunStatistics(options()),
                          [&](int, StepRecord& r) {
                              r.contact_force.x() = -sample(generator);
                              return kNothing;
                          },
                          {20.0, 2.0, lengths});
    };
    CHECK(after(1.0).warnings.empty());
    const Summary few = after(0.68);
    REQUIRE(few.warnings.size() == 1);
    CHECK_THAT(few.warnings[0].text,
               Catch::StartsWith("forces are averaged over 0.68 ship lengths, less than one, of "
                                 "2.00 travelled"));
    REQUIRE(std::isfinite(few.resistance.ci95));
    CHECK(few.warnings[0].share.value() == Near(few.resistance.ci95 / few.resistance.mean));
    // the verdict follows the share
    CHECK(few.warnings[0].affects_mean == (*few.warnings[0].share > kMatters));
    const Summary wide = after(0.68, 60.0), narrow = after(0.68, 1.0);  // 4 %, 0.06 %
    CHECK(wide.warnings.at(0).affects_mean == true);
    CHECK(narrow.warnings.at(0).affects_mean == false);
    // a trend says more, and why
    const Summary rising = summary_of(RunStatistics(options()),
                                      [](int k, StepRecord& r) {
                                          r.contact_force.x() -= 0.05 * (k - 499.5);
                                          return kNothing;
                                      },
                                      {20.0, 2.0, 0.68});
    REQUIRE(rising.warnings.size() == 1);
    CHECK_THAT(rising.warnings[0].text, Catch::Contains("rises by 50 %") &&
                                            Catch::Contains("0.68 ship lengths, less than one"));
}

TEST_CASE("a force that changes about a mean of zero is given no share of it", "[record]") {
    StatisticsOptions all = options();
    all.average_from = 0.0;
    RunStatistics statistics(all);
    for (int k = 0; k < 1000; ++k)
        statistics.add(step_of(k < 500 ? -1.0 : 1.0), 0.01 * k, 0.01, {});
    Summary s;
    statistics.fill(s);
    CHECK(s.resistance.mean == 0.0);
    for (const Warning& w : s.warnings) CHECK_THAT(w.text, !Catch::Contains("inf"));
}

TEST_CASE("bodies that meet too fast are warned of with what their steps do to the mean",
          "[record][analytic]") {
    const Summary s = summary_of(RunStatistics(options()), [](int k, StepRecord& r) {
        r.closing_speed = k == 700 ? 5.0 : 1.0;
        return kNothing;
    });
    REQUIRE(s.warnings.size() == 1);
    CHECK_THAT(s.warnings[0].text, Catch::Contains("met at 5 m/s at t = 8.01 s"));
    CHECK(s.warnings[0].affects_mean == false);
    CHECK(s.warnings[0].share.value() < 0.001);
}

TEST_CASE("overlaps that no contact knows are warned of with the loads on the hull of their floes",
          "[record][analytic]") {
    // at each check in the averaged time floe 1 brings 97, floe 2 brings 3 and floe 3 none
    const auto overlaps = [](const std::vector<UnseenOverlap>& pairs) {
        RunStatistics statistics(options());
        for (int k = 0; k < 10; ++k) {
            StepRecord r;
            r.regions = {{1, 0, Vec3(-97, 0, 0)}, {2, 0, Vec3(-3, 5, 0)}};
            statistics.add_check({0.04, pairs}, r, 2.0 + k);
            // before the averaged time: of no effect on the mean
            statistics.add_check({0.04, {{0, 1, 0.03}}}, r, 0.5);
        }
        return summary_of(statistics, [](int, StepRecord&) { return kNothing; });
    };
    const auto share = [&](const std::vector<UnseenOverlap>& pairs) {
        const Summary s = overlaps(pairs);
        REQUIRE(s.warnings.size() == 1);
        CHECK_THAT(s.warnings[0].text, Catch::Contains("more than their contacts show"));
        CHECK(s.warnings[0].affects_mean == true);
        return s.warnings[0].share.value();
    };
    CHECK(share({{0, 2, 0.06}}) == Near(0.03));
    CHECK(share({{1, 2, 0.06}}) == Near(1.0));
    CHECK(share({{0, 3, 0.06}}) == Near(0.5));  // lacks a mean load, 1 to 2 that are there
    CHECK(share({{0, 2, 0.06}, {0, 3, 0.07}}) == Near(0.53));
    const Summary behind = overlaps({{3, 4, 0.06}});  // does not touch the hull
    CHECK(behind.warnings.empty());
    CHECK(behind.unseen_overlap == 0.06);  // the report's figure
    CHECK(overlaps({{0, 2, 0.04}}).warnings.empty());
}

TEST_CASE("what was warned of at the start gets the verdict of what the run measured",
          "[record][analytic]") {
    const auto judged_by = [](double separation, const std::vector<UnseenOverlap>& pairs) {
        RunStatistics statistics(options());
        StepRecord r = step_of(100.0);
        r.regions = {{1, 0, Vec3(-97, 0, 0)}, {2, 0, Vec3(-3, 0, 0)}};
        statistics.add_check({0.06, pairs}, r, 2.0);
        for (int k = 0; k < 1000; ++k) statistics.add(r, 2.0 + 0.01 * k, 0.01, {});
        Summary s;
        s.warnings = {{"spheres are far apart"}, {"the ship meets the ice late", true, 0.3}};
        s.energy["ship_work_J"] = 1000.0;
        s.energy["separation_J"] = -separation;
        statistics.fill(s);
        CHECK(s.warnings.at(1) == Warning{"the ship meets the ice late", true, 0.3});
        return s.warnings.at(0);
    };
    CHECK(judged_by(0.0, {}) == Warning{"spheres are far apart", false, 0.0});
    CHECK(judged_by(5.0, {}) == Warning{"spheres are far apart", false, 0.005});
    CHECK(judged_by(50.0, {{0, 2, 0.06}}) == Warning{"spheres are far apart", true, 0.05});
    CHECK(judged_by(5.0, {{0, 2, 0.06}}) == Warning{"spheres are far apart", true, 0.03});
}

TEST_CASE("what a contact owes is the floe's mass times the speed at which it still closes",
          "[record][analytic]") {
    World w = test::plate_world(test::empty_space(0.01), Vec3(4, 4, 0.4), 0.1, 0.1, 0.0);
    const auto box = test::add_shape(w, test::make_box_set(Vec3(1, 0.8, 0.3), 0.05, 0.1));
    const std::size_t i =
        add_floe(w.scene, box, 900.0, Vec3(0, 0, -0.5), Quaternion::Identity(), 0, false);
    Bodies& b = w.scene.bodies;
    const auto moving_at = [&](double speed) {
        b.momentum[i] = b.mass[i] * Vec3(0, 0, speed);
        update_derived(b, i);
    };
    Constraint c{};
    c.a = 0;
    c.b = static_cast<std::int32_t>(i);
    c.can_move = true;
    c.normal = -Vec3::UnitZ();  // the floe lies under the plate
    c.arm_a.setZero();
    c.arm_b = Vec3(0, 0, 0.15);  // through the centre: k(n) = 1 / m
    c.max_impulse = std::numeric_limits<double>::infinity();

    moving_at(0.2);
    CHECK(residual_impulse(b, {c}, 0.01) == Near(0.2 * b.mass[i]));
    c.gap = 0.001;  // room for 0.1 m/s within the step
    CHECK(residual_impulse(b, {c}, 0.01) == Near(0.1 * b.mass[i]));
    c.gap = 0.0;
    c.max_impulse = c.rest_normal = 3.0;  // it crushes: it may close
    CHECK(residual_impulse(b, {c}, 0.01) == 0.0);
    c.max_impulse = std::numeric_limits<double>::infinity();
    moving_at(-0.2);  // pushed apart by 3 N s where less would do
    CHECK(residual_impulse(b, {c}, 0.01) == Near(std::min(3.0, 0.2 * b.mass[i])));
    c.impact_normal = 1.0;  // unless it rebounds
    CHECK(residual_impulse(b, {c}, 0.01) == 0.0);
    c.can_move = false;
    moving_at(0.2);
    CHECK(residual_impulse(b, {c}, 0.01) == 0.0);
}
