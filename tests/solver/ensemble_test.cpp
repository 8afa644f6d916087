// SPDX-License-Identifier: GPL-3.0-or-later
// Members of an ensemble as one summary, and results as lines for a terminal.
//
// Tolerances: 1e-6 is the last digit of Student's factor in a table.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "solver/ensemble/average_members.hpp"
#include "solver/record/result_text.hpp"
#include "solver/record/warn_of_trend.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Member member(std::int64_t seed, double mean) {
    Member m;
    m.seed = seed;
    m.summary.resistance.mean = mean;
    m.summary.resistance.contact_mean = 0.7 * mean;
    m.summary.resistance.max = 10.0 * mean;
    m.summary.steps = 1000;
    m.summary.simulated_s = 20.0;
    m.summary.floes_moved = seed;
    m.summary.energy["drag_J"] = mean;
    m.summary.regions["bow"].hits = 3;
    m.summary.regions["bow"].mean = {-mean, 0.0, 0.0};
    return m;
}

}  // namespace

TEST_CASE("an ensemble's mean is its members', its interval Student's", "[ensemble][analytic]") {
    std::vector<Member> members{member(1, 100.0), member(2, 110.0), member(3, 120.0)};
    members[1].summary.warnings = {{"floe 3 fell off", true, 0.25}};
    const Summary s = average_members(members);
    const double half_width = 4.302653 * 10.0 / std::sqrt(3.0);  // t(0.975, 2), s = 10
    CHECK(s.resistance.mean == Near(110.0));
    CHECK(s.resistance.ci95 == Near(half_width).epsilon(1e-6));
    CHECK(s.resistance.contact_mean == Near(77.0));
    CHECK(s.resistance.max == 1200.0);
    CHECK(s.resistance.effective_samples == 3.0);
    REQUIRE(s.ensemble);
    CHECK(s.ensemble->mean == Near(110.0));
    CHECK(s.ensemble->means == std::vector<double>{100.0, 110.0, 120.0});
    CHECK(s.ensemble->seeds == std::vector<std::int64_t>{1, 2, 3});
    CHECK(s.steps == 3000);
    CHECK(s.simulated_s == Near(60.0));
    CHECK(s.floes_moved == 2);
    CHECK_FALSE(s.cracks);
    CHECK(s.energy.at("drag_J") == Near(110.0));
    CHECK(s.regions.at("bow").hits == 9);
    CHECK(s.regions.at("bow").mean[0] == Near(-110.0));
    REQUIRE(s.warnings.size() == 1);
    CHECK(s.warnings[0] == Warning{"seed 2: floe 3 fell off", true, 0.25});
}

TEST_CASE("an ensemble's summary has no numbers of one member alone", "[ensemble][analytic]") {
    std::vector<Member> members{member(1, 100.0), member(2, 110.0)};
    for (std::size_t k = 0; k < 2; ++k) {
        Summary& s = members[k].summary;
        s.panels.size = 1.0;
        s.panels.hardest.emplace_back("bow", PanelLoad{});
        s.regions["bow"].force_peaks = PeakStatistics{};
        s.imbalance["momentum"] = k == 0 ? 1e-12 : 3e-12;
        s.ice.floe_size_min = 2.0 + static_cast<double>(k);
        s.ice.floe_size_mean = 4.0 + static_cast<double>(k);
        s.ice.floe_size_max = 8.0 + static_cast<double>(k);
        s.ice.concentration = 0.7 + 0.1 * static_cast<double>(k);
        s.ice.floes = 10 + 2 * static_cast<std::int64_t>(k);
        s.cracks = CrackParticulars{.radius = 2.0 + static_cast<double>(k),
                                    .characteristic_length = 10.0,
                                    .thickness = 0.5};
    }
    const Summary s = average_members(members);
    REQUIRE(s.cracks);
    CHECK(s.cracks->radius == Near(2.5));
    CHECK(s.cracks->per_length() == Near(0.25));
    CHECK(s.panels.size == 0.0);
    CHECK(s.panels.hardest.empty());
    CHECK_FALSE(s.regions.at("bow").force_peaks);
    CHECK(s.imbalance.at("momentum") == 3e-12);
    CHECK(s.ice.floe_size_min == 2.0);
    CHECK(s.ice.floe_size_mean == Near(4.5));
    CHECK(s.ice.floe_size_max == 9.0);
    CHECK(s.ice.concentration == Near(0.75));
    CHECK(s.ice.floes == 11);
    CHECK(std::isnan(s.ice.thickness));  // unknown in both
}

TEST_CASE("a warning that all members share stands once, with the largest share", "[ensemble]") {
    std::vector<Member> members{member(1, 100.0), member(2, 110.0)};
    members[0].summary.warnings = {{"short", false, 0.01}, {"jam", true, 0.5}};
    members[1].summary.warnings = {{"short", true, 0.03}};
    CHECK(average_members(members).warnings ==
          std::vector<Warning>{{"short", true, 0.03}, {"seed 1: jam", true, 0.5}});
}

TEST_CASE("a trend stands where more members show one than chance explains", "[ensemble]") {
    const auto warnings = [](std::size_t size, std::size_t showing) {
        std::vector<Member> members;
        for (std::size_t k = 0; k < size; ++k) {
            members.push_back(member(static_cast<std::int64_t>(k) + 1, 100.0));
            if (k >= showing) continue;
            Summary& s = members.back().summary;
            s.resistance.trend = 10.0 + static_cast<double>(k);
            s.resistance.trend_significant = true;
            s.warnings = {warn_of_trend(s), {"floe 3 fell off", true, 0.25}};
        }
        const Summary s = average_members(members);
        return std::count_if(s.warnings.begin(), s.warnings.end(), [](const Warning& w) {
            return w.text.find("resistance rises by") != std::string::npos;
        });
    };
    CHECK(warnings(1, 1) == 1);
    CHECK(warnings(3, 1) == 0);   // 1 - 0.99^3 = 3.0 %
    CHECK(warnings(3, 2) == 2);   // 3 x 0.01^2 = 0.03 %
    CHECK(warnings(15, 2) == 2);  // 0.96 %
    CHECK(warnings(16, 2) == 0);  // 1.09 %
    CHECK(warnings(16, 3) == 3);
}

TEST_CASE("a trend within less than a ship length is no chance, and hides no short averages",
          "[ensemble]") {
    // two members over 0.74 ship lengths; the second one has a trend of 52 %, which chance gives
    // one of two members too often to count in a longer window
    const auto gathered = [](double lengths, double second_lengths) {
        std::vector<Member> members{member(1, 400.0), member(2, 440.0)};
        for (Member& m : members) {
            m.summary.travel = {20.0, 2.0, m.seed == 1 ? lengths : second_lengths};
            m.summary.resistance.ci95 = 0.09 * m.summary.resistance.mean;
        }
        if (lengths < 1.0)
            members[0].summary.warnings = {warn_of_short_averages(members[0].summary)};
        Summary& s = members[1].summary;
        s.resistance.ci95 = 0.2 * s.resistance.mean;
        s.resistance.trend = 0.52 * s.resistance.mean;
        s.resistance.trend_significant = true;
        s.warnings = {warn_of_trend(s)};
        return average_members(members).warnings;
    };
    CHECK(gathered(1.2, 1.2).empty());
    const auto both = gathered(0.74, 0.74);
    REQUIRE(both.size() == 2);
    CHECK_THAT(both[0].text, Catch::StartsWith("forces are averaged over 0.74 ship lengths"));
    CHECK(both[0].share.value() == Near(0.2));  // the worst of all
    CHECK_THAT(both[1].text, Catch::StartsWith("seed 2: the resistance rises by 52 %"));
    CHECK(both[1].share.value() == Near(0.26));
    // members that travel differently have warnings of their own
    const auto one = gathered(1.2, 0.74);
    REQUIRE(one.size() == 1);
    CHECK_THAT(one[0].text, Catch::StartsWith("seed 2: the resistance rises by 52 %") &&
                                Catch::Contains("0.74 ship lengths, less than one"));
    const auto other = gathered(0.74, 0.6);
    REQUIRE(other.size() == 2);
    CHECK_THAT(other[0].text, Catch::StartsWith("seed 1: forces are averaged over 0.74"));
    CHECK_THAT(other[1].text, Catch::StartsWith("seed 2: the resistance rises by 52 %"));
}

TEST_CASE("one member alone has a mean and no interval", "[ensemble]") {
    const Summary s = average_members({member(7, 100.0)});
    CHECK(s.resistance.mean == 100.0);
    CHECK(std::isnan(s.ensemble->ci95));
    CHECK_THAT(ensemble_line(s), Catch::Contains("100.0 N (one member: no interval)"));
}

TEST_CASE("a force is printed to two digits of its interval, in kN from 10 kN on",
          "[record][analytic]") {
    CHECK(force_text(1406.31, 55.4, 3) == "1406 +- 55 N");
    CHECK(force_text(439593.7, 47203.7, 3) == "440 +- 47 kN");
    CHECK(force_text(2003.6, 104.6, 3) == "2000 +- 100 N");
    CHECK(force_text(1810.05, 107.4, 2) == "1810 +- 110 N/m");
    CHECK(force_text(0.1234, 0.0123, 3) == "0.123 +- 0.012 N");
    CHECK(force_text(24391.0, 812.0, 3) == "24.39 +- 0.81 kN");
    CHECK(force_text(1406.31, kNaN, 3) == "1406 N (too short for an interval)");
    CHECK(force_text(1421.4) == "1421 N");
}

TEST_CASE("a run without averages, or without a touch, says so in place of numbers", "[record]") {
    Summary s;
    s.ship.speed_mean = 0.5;
    s.floes_moved = 3;
    s.floes_total = 9;
    s.resistance.mean = s.resistance.ci95 = kNaN;
    s.contacts_max = 4.0;
    CHECK(resistance_line(s) ==
          "resistance unknown: the run ended before output.average_from; 3 of 9 floes moved");
    s.resistance.mean = s.resistance.ci95 = 0.0;
    s.contacts_max = 0.0;
    CHECK(resistance_line(s) ==
          "no contact: nothing touched the ship at 0.5 m/s (0.972 kn); 3 of 9 floes moved");
}

TEST_CASE("the formulas' line compares level ice with totals, broken ice with a part", "[record]") {
    Summary s;
    CHECK(formulas_line(s).empty());
    s.lindqvist_submersion = 403300.0;
    s.formulas = {{"Lindqvist 1989", "submersion", 403300.0, false},
                  {"Lindqvist 1989", "total", 791600.0, false},
                  {"Riska 1997", "total", 688400.0, false},
                  {"Jeong 2010", "buoyancy + clearing", 310000.0, false},
                  {"Jeong 2010", "total", 700000.0, true}};
    s.ice.hold = {"never", "always"};
    CHECK(formulas_line(s) == "Lindqvist's submersion resistance: 403.3 kN");
    s.ice.hold = {"until-bent", "always"};
    CHECK(formulas_line(s) ==
          "formulas for level ice, total: 688.4 to 791.6 kN (Lindqvist 1989, Riska 1997, Jeong "
          "2010); recalled, compared with no published number: Lindqvist 1989, Riska 1997");
    s.formulas = {{"Riska 1997", "total", 688400.0, false}};
    CHECK(formulas_line(s) ==
          "formulas for level ice, total: 688.4 kN (Riska 1997); recalled, compared with no "
          "published number: Riska 1997");
    s.formulas = {{"Jeong 2010", "total", 700000.0, true}};
    CHECK(formulas_line(s) == "formulas for level ice, total: 700.0 kN (Jeong 2010)");
    s.formulas.clear();
    CHECK(formulas_line(s).empty());
}

TEST_CASE("the resistance's line has both units of speed, the energy's the shares worth a word",
          "[record]") {
    Summary s;
    s.resistance = {439593.7, 300000.0, 139593.7, 1.0, 1.0, 47203.7};
    s.ship.speed_mean = 2.05778;
    s.floes_moved = 60;
    s.floes_total = 84;
    CHECK(resistance_line(s) ==
          "resistance 440 +- 47 kN (95 %) at 2.06 m/s (4 kn): contact 300, friction 140; 60 of 84 "
          "floes moved");
    CHECK(energy_line(s).empty());
    for (const char* key : {"potential_J", "kinetic_change_J", "crushing_J", "buoyancy_moment_J",
                            "separation_J", "residual_J"})
        s.energy[key] = 0.0;
    s.energy["ship_work_J"] = 42643.0;
    s.energy["friction_J"] = 0.37 * 42643.0;
    s.energy["drag_J"] = 0.146 * 42643.0;
    s.energy["restitution_J"] = 0.484 * 42643.0;
    s.energy["residual_J"] = 0.004 * 42643.0;
    CHECK(energy_line(s) == "work of the ship 42.64 kJ: impacts 48 %, friction 37 %, drag 15 %");
}
