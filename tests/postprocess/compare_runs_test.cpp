// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/report/compare_runs.hpp"

#include <catch2/catch.hpp>

#include "postprocess/report/draw_plot.hpp"
#include "tests/postprocess/make_folder.hpp"

using namespace ice;
using namespace ice::test;
using namespace ice::report;

TEST_CASE("runs are compared a line each, missing values as a dash", "[report]") {
    Summary a = *make_folder().summary, b = a;
    b.resistance.mean = -0.25;
    b.resistance.ci95 = std::nan("");
    b.lindqvist_submersion.reset();
    b.unconverged_steps = 45;
    b.status = "interrupted";
    a.warnings = {{"a trend", true, 0.25}, {"overlap", false, 0.01}};  // and b: not measured
    const std::string text = compare_text({{"results/a", a}, {"results/longer", b}});
    CHECK(count(text, "\n") == 3);
    CHECK_THAT(text, Catch::Contains("results/a         1107      12"));
    CHECK_THAT(text,
               Catch::Contains("954            5              0  until-hull-contact  completed"
                               "            25\n"));
    CHECK_THAT(text, Catch::Contains("results/longer   -0.25       -"));
    // 45 of 450 steps
    CHECK_THAT(text, Catch::Contains("10  until-hull-contact  interrupted           -\n"));

    const std::string csv = compare_csv({{"a, \"b\"", b}});
    CHECK_THAT(csv, Catch::StartsWith("run,mean_N,ci95_N,contact_N,friction_N,std_N,max_N,"));
    CHECK_THAT(csv, Catch::Contains("\n\"a, \"\"b\"\"\",-0.25,,1006,101,143,1320,,5,10,"
                                    "until-hull-contact,interrupted,\n"));
    // columns are added at the end only: scripts count on the others' places
    CHECK_THAT(csv, Catch::Contains(",hold,status,affected_%\n"));
    CHECK_THAT(compare_csv({{"a", a}}), Catch::EndsWith(",completed,25\n"));
    a.warnings.clear();
    CHECK_THAT(compare_csv({{"a", a}}), Catch::EndsWith(",completed,0\n"));
    CHECK(compare_text({}).find("mean_N") != std::string::npos);
}

TEST_CASE("in level ice the column of Lindqvist is his total, which compares with the mean",
          "[report]") {
    Summary s = *make_folder().summary;
    s.formulas = {{"Lindqvist 1989", "submersion", 954.0, false},
                  {"Lindqvist 1989", "bending", 400.0, false},
                  {"Lindqvist 1989", "total", 2345.0, false},
                  {"Riska 1997", "total", 3000.0, false}};
    CHECK_THAT(compare_csv({{"broken", s}}), Catch::Contains(",1320,954,5,"));
    s.ice.hold = {"until-bent", "always"};
    CHECK_THAT(compare_csv({{"level", s}}), Catch::Contains(",1320,2345,5,"));
    s.formulas.clear();  // no number rather than a part beside a total
    CHECK_THAT(compare_csv({{"level", s}}), Catch::Contains(",1320,,5,"));
}

TEST_CASE("the mean of an ensemble is affected as that of its worst member", "[report]") {
    const TempFolder folder;
    Summary s = *make_folder().summary;
    s.warnings = {{"short averages", true, 0.05}};
    const auto write = [&](const char* name, const Summary& summary) {
        std::filesystem::create_directories(folder / name);
        write_bytes(folder / name / "summary.json", summary_text(summary));
    };
    write("seed-1", s);
    Summary trend = s;
    trend.warnings = {
        {"short averages", true, 0.04}, {"a trend", true, 0.19}, {"overlap", false, 0.01}};
    write("seed-2", trend);
    s.ensemble = Ensemble{1107.0, 12.0, {1100.0, 1114.0}, {1, 2, 3}};  // seed-3 was deleted
    write(".", s);
    const Summary read = read::read_with_members(folder.path());
    REQUIRE(read.warnings.size() == 2);
    CHECK(read.warnings[0].text == "short averages");
    CHECK(read.warnings[1].text == "seed 2: a trend");
    CHECK_THAT(compare_csv({{"ensemble", read}}), Catch::EndsWith(",completed,19\n"));
    CHECK(read::read_with_members(folder / "seed-1").warnings.size() == 1);
}

TEST_CASE("runs in 3D and in 2D never share a column: two tables, and no CSV of both", "[report]") {
    const Summary solid = *make_folder().summary;
    Summary flat = *make_folder({.dimension = 2}).summary;
    const std::string text = compare_text({{"flat", flat}, {"solid", solid}});
    CHECK(count(text, "mean_N_per_m") == 1);
    CHECK(count(text, " mean_N ") == 1);
    CHECK(text.find("solid") < text.find("\n\n"));
    CHECK(text.find("\n\n") < text.find("flat"));
    CHECK(count(compare_text({{"flat", flat}}), "\n") == 2);
    CHECK_THAT(compare_csv({{"flat", flat}}), Catch::StartsWith("run,mean_N_per_m,ci95_N_per_m,"));
    CHECK_THAT(error_text([&] {
                   compare_csv({{"flat", flat}, {"solid", solid}});
               }),
               Catch::Contains("newtons per metre"));
}

TEST_CASE(
    "the plot of a run has its forces, coverage, paths and tracked floes, in 2D no lateral ones",
    "[report]") {
    const std::string svg = draw_plot(make_folder());
    CHECK(tag_fault(svg).empty());
    for (const char* title : {"Resistance, moving average", "on the ship, x", "on the ship, y",
                              "on the ship, z", "Bottom covered by ice", "from above",
                              "from starboard", "on the ship, contact", "on the ship, friction"}) {
        CAPTURE(title);
        CHECK_THAT(svg, Catch::Contains(title));
    }
    const std::string flat = draw_plot(make_folder({.dimension = 2}));
    CHECK(flat.find("from above") == std::string::npos);
    CHECK(flat.find("on the ship, y") == std::string::npos);
    read::RunFolder none = make_folder();
    none.data.history.clear();
    CHECK_THAT(error_text([&] { draw_plot(none); }), Catch::Contains("no histories to plot"));
}
