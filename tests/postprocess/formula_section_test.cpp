// SPDX-License-Identifier: GPL-3.0-or-later
// The formulas beside a run and beside a sweep.
#include "postprocess/report/formula_section.hpp"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "postprocess/report/evaluate_run.hpp"
#include "postprocess/report/sections.hpp"
#include "postprocess/report/write_report.hpp"
#include "postprocess/sweep/formula_curves.hpp"
#include "postprocess/sweep/sweep_tables.hpp"
#include "postprocess/sweep/write_sweep.hpp"
#include "tests/postprocess/write_runs.hpp"

using namespace ice;
using namespace ice::test;
using namespace ice::report;

namespace {

// an icebreaker in ice of 1 m at 4 knots
Summary icebreaker() {
    Summary s = *make_folder().summary;
    s.ship.length = 95.0;
    s.ship.breadth = 22.0;
    s.ship.draught = 8.0;
    s.ship.stem_angle_deg = 25.0;
    s.ship.entrance_angle_deg = 30.0;
    s.ship.parallel_length = 33.0;
    s.ship.bow_length = 24.0;
    s.ship.speed_mean = 2.058;
    s.ice.thickness = 1.0;
    s.ice.friction_ship_ice = 0.1;
    s.ice.water_density = 1025.0;
    s.ice.gravity = 9.81;
    s.resistance.mean = 441e3;
    s.resistance.ci95 = 47e3;
    return s;
}

}  // namespace

TEST_CASE("broken ice stands beside submersion and clearing, level ice beside totals", "[report]") {
    Summary s = icebreaker();
    evaluate_run(s, {});
    const ForceUnit unit = choose_unit(s.resistance.mean, 3);
    const std::string broken = formula_section(s, unit);
    CHECK(tag_fault(broken).empty());
    CHECK_THAT(broken, Catch::Contains("parts for broken ice"));
    CHECK_THAT(broken, !Catch::Contains("Riska") && !Catch::Contains("kPa"));
    CHECK_THAT(broken, Catch::Contains(">clearing</text>") &&
                           Catch::Contains("Lindqvist 1989 (submersion)") &&
                           Catch::Contains("Jeong 2010 (buoyancy, clearing, buoyancy + clearing)"));

    s.ice.hold = {"until-bent"};
    evaluate_run(s, {});  // nobody states a strength: 500 kPa, which the page says
    const std::string level = formula_section(s, unit);
    CHECK_THAT(level, Catch::Contains("compared with the totals of the formulas") &&
                          Catch::Contains("Level ice of 500 kPa") && Catch::Contains("Riska 1997"));
    // Lindqvist's and Jeong's three parts, Riska's one; the run and the band
    CHECK(count(draw_formulas(s, unit, 600.0), "<rect") ==
          1 + 1 + 3 + 3 + 1 + 7 /* names in the legend */);

    // the run's own parts beside the formulas': 100 of 441 kN broke ice
    s.resistance.breaking_mean = 100e3;
    s.resistance.submersion_mean = 341e3;
    const std::string parts = draw_formulas(s, unit, 440.0);
    CHECK(count(parts, "<rect") == 1 + 2 + 3 + 3 + 1 + 8);
    CHECK_THAT(parts, Catch::Contains(">submersion and all else</text>"));
    // the legend goes on in another row where the picture ends
    CHECK_THAT(parts, Catch::Contains("y=\"36\"") && Catch::Contains("y=\"54\""));

    FormulaOptions strong;
    strong.flexural_strength = 1e6;
    evaluate_run(s, strong);
    CHECK_THAT(formula_section(s, unit), Catch::Contains("Level ice of 1000 kPa"));
    s.ice.flexural_strength = 4.5e5;  // of the run, which a strength for the formulas leaves alone
    evaluate_run(s, strong);
    CHECK_THAT(formula_section(s, unit), Catch::Contains("Level ice of 1000 kPa"));
    CHECK_THAT(particulars_section(s, 1.0), Catch::Contains("450 kPa"));
}

TEST_CASE("a summary that does not say what formulas need keeps what it has", "[report]") {
    Summary s = *make_folder().summary;
    s.ice.water_density = kUnknown;
    const auto before = s.formulas;
    evaluate_run(s, {});
    CHECK(s.formulas.size() == before.size());
    s.formulas.clear();
    s.lindqvist_submersion.reset();
    CHECK(formula_section(s, choose_unit(1.0, 3)).empty());
    CHECK(draw_formulas(s, choose_unit(1.0, 3), 600.0).empty());
    CHECK(formula_footnote({{"A", "total", 1.0, true}}).empty());
}

TEST_CASE("a run outside the band of the formulas says so, with the percentage", "[report]") {
    Summary s = *make_folder().summary;
    CHECK(band_verdict(s).empty());  // one formula is no band
    s.formulas = {{"A", "total", 250e3, true}, {"B", "total", 360e3, true}};
    s.ice.hold = {"until-bent"};
    const std::vector<std::pair<double, std::string>> cases{
        {145e3, "The run lies 42 % below this band."},
        {450e3, "The run lies 25 % above this band."},
        {240e3, "The run lies 4.0 % below this band."},
        {300e3, "The run lies within this band."}};
    for (const auto& [mean, verdict] : cases) {
        s.resistance.mean = mean;
        CHECK(band_verdict(s) == verdict);
        CHECK_THAT(formula_section(s, choose_unit(4e5, 3)), Catch::Contains(verdict));
        CHECK_THAT(key_numbers(s, choose_unit(4e5, 3), 2.0), Catch::Contains(verdict));
    }
    CHECK_THAT(formula_section(s, choose_unit(4e5, 3)), Catch::Contains("we have not read"));
}

TEST_CASE("a sweep's chart has the band of its formulas, its CSV a column for each part",
          "[sweep]") {
    using namespace ice::sweep;
    const TempFolder folder;
    for (const double speed : {0.5, 1.0})
        write_run(folder / fmt::format("u{}", speed), speed, 0.1, 1, 1000.0 * speed);
    const Sweep sweep = read_sweep(folder.path());
    const auto points = make_points(sweep);
    REQUIRE(points.size() == 2);
    const auto band = formula_band(points[1]);
    REQUIRE(band);
    CHECK(band->low == 280.0);   // 200 + 80 u
    CHECK(band->high == 600.0);  // 500 + 100 u
    const auto curves = comparable_curves(make_curves(sweep, points));
    REQUIRE(curves.size() == 2);
    CHECK(curves[0].legend == "Lindqvist");
    CHECK(curves[1].part == "buoyancy + clearing");
    CHECK(author_of("our ship") == "our ship");
    const std::string csv = point_csv(sweep, points);
    CHECK_THAT(csv, Catch::Contains(",jeong_2010_buoyancy_clearing_N,") &&
                        Catch::Contains(",600,200,80,280,until-hull-contact,,"));
    const std::string chart = make_sweep_curve(sweep);
    CHECK_THAT(chart, Catch::Contains(">formulas</text>") && Catch::Contains(">Jeong</text>"));
    const std::string page = make_sweep_page(sweep, folder / "sweep.html");
    CHECK(tag_fault(markup_of(page)).empty());
    CHECK_THAT(page, Catch::Contains("Jeong 2010, buoyancy + clearing") &&
                         Catch::Contains(">Jeong, buoyancy</text>") &&
                         Catch::Contains("Recalled, compared with no published number"));
}
