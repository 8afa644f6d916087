// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "postprocess/report/write_report.hpp"
#include "postprocess/sweep/affected_runs.hpp"
#include "postprocess/sweep/formula_curves.hpp"
#include "postprocess/sweep/split_sweep.hpp"
#include "postprocess/sweep/sweep_charts.hpp"
#include "postprocess/sweep/sweep_head.hpp"
#include "postprocess/sweep/sweep_markdown.hpp"
#include "postprocess/sweep/sweep_points.hpp"
#include "postprocess/sweep/sweep_tables.hpp"
#include "postprocess/sweep/write_sweep.hpp"
#include "tests/postprocess/write_runs.hpp"

using namespace ice;
using namespace ice::test;
using namespace ice::sweep;

TEST_CASE("the page of a sweep has curves, small multiples, tables and CSV", "[sweep]") {
    const TempFolder folder;
    write_grid(folder);
    write_bytes(folder / "runs/u0.5m0.1s1/report.html", "");
    const Sweep sweep = read_sweep(folder.path());
    const std::string page = make_sweep_page(sweep, folder / "pages/sweep.html");
    CHECK(tag_fault(markup_of(page)).empty());
    // overview, peaks and two frictions, each for wide and for narrow windows
    CHECK(count(page, "<svg xmlns") == 8);
    CHECK_THAT(page, Catch::Contains("Resistance [N] against speed [m/s]"));
    CHECK_THAT(page, Catch::Contains(">speed [kn]</text>"));
    CHECK_THAT(page, Catch::Contains("(0.97 to 1.94 kn)"));
    CHECK_THAT(page, Catch::Contains(">Lindqvist</text>"));
    CHECK_THAT(page, Catch::Contains("../runs/u0.5m0.1s1/report.html"));
    CHECK_THAT(page, Catch::Contains("rest: hull"));
    CHECK_THAT(page, Catch::Contains("download=\"points.csv\""));
    CHECK(count(page, "id=\"faults\"") == 0);

    const std::string csv = point_csv(sweep, make_points(sweep));
    CHECK(count(csv, "\r\n") == 5);
    CHECK_THAT(csv, Catch::StartsWith("contact.friction_ship_ice,hull.speed,runs,resistance_N,"
                                      "resistance_ci95_N,bow_N,"));
    CHECK_THAT(csv, Catch::Contains("\r\n0.1,0.5,3,510,"));
    CHECK_THAT(csv, Catch::Contains(",hold,affected_%,breaking_N,breaking_ci95_N,submersion_N,"
                                    "submersion_ci95_N,crack_radius_m,") &&
                        Catch::Contains(",until-hull-contact,,,,,,,,,,\r\n"));  // not measured
    CHECK_THAT(page, Catch::Contains("<th scope=\"col\">release rule</th>"));
    CHECK(count(run_csv(sweep), "\r\n") == 13);
    CHECK(encode_address("a b/c=1,2%\u00e4") == "a%20b/c%3D1%2C2%25%C3%A4");
}

TEST_CASE("a sweep says how many runs have warnings that affect their mean, and by how much",
          "[sweep]") {
    const TempFolder folder;
    const auto write = [&](double speed, const std::vector<Warning>& warnings) {
        const auto run = folder / fmt::format("u{}", speed);
        write_run(run, speed, 0.1, 1, 1000.0 * speed);
        Summary s = read_summary(run / "summary.json");
        s.warnings = warnings;
        write_bytes(run / "summary.json", summary_text(s));
    };
    write(0.5, {{"a trend <up>", true, 0.37}, {"overlap", false, 0.01}});
    write(0.75, {{"short averages", true, 0.09}});
    write(1.0, {{"a picture is wrong", false}});
    Sweep sweep = read_sweep(folder.path());
    const std::string line =
        "2 of 3 completed runs have warnings that affect their mean, by up to 37 %";
    CHECK(affected_line(sweep) == line);

    std::string page = make_sweep_page(sweep, folder / "sweep.html");
    CHECK(tag_fault(markup_of(page)).empty());
    CHECK(page.find("3 of 3 runs completed") < page.find(line));
    CHECK(count(page, line) == 2);  // in the head, and over the texts
    CHECK_THAT(page, Catch::Contains("<a href=\"u0.5\">u0.5</a>: a trend &lt;up&gt; (affects the "
                                     "mean resistance: about 37 % of it)</li>"));
    CHECK_THAT(page, Catch::Contains("short averages (affects") &&
                         !Catch::Contains("overlap (hardly") &&
                         !Catch::Contains("a picture is wrong"));
    CHECK_THAT(page, Catch::Contains("<th scope=\"col\">Mean affected by [%]</th>") &&
                         Catch::Contains("<td>37</td></tr>"));
    const std::string points = point_csv(sweep, make_points(sweep)), runs = run_csv(sweep);
    CHECK_THAT(points, Catch::Contains(",until-hull-contact,37,"));
    CHECK_THAT(points, Catch::EndsWith(",until-hull-contact,0,,,,,,,,,\r\n"));
    CHECK_THAT(runs, Catch::Contains(",remark,affected_%\r\n") && Catch::Contains(",,37\r\n") &&
                         Catch::EndsWith(",,0\r\n"));

    // one run, and a share that nothing has measured
    write(0.5, {});
    write(0.75, {{"nothing touched anything", true}});
    sweep = read_sweep(folder.path());
    CHECK(affected_line(sweep) ==
          "1 of 3 completed runs has warnings that affect its mean; by how much was not measured");
    CHECK_THAT(run_csv(sweep), Catch::Contains(",,\r\n"));
    write(0.75, {});
    sweep = read_sweep(folder.path());
    CHECK(affected_line(sweep).empty());
    page = make_sweep_page(sweep, folder / "sweep.html");
    CHECK(page.find("id=\"affected\"") == std::string::npos);
}

TEST_CASE("a point of several runs is affected as much as the worst of them", "[sweep]") {
    const TempFolder folder;
    write_grid(folder);
    Sweep sweep = read_sweep(folder.path());
    for (SweepRun& run : sweep.runs) run.summary->warnings.clear();
    sweep.runs[0].summary->warnings = {{"a trend", true, 0.25}};  // of mu = 0.1, u = 0.5
    sweep.runs[1].summary->warnings = {{"a jam", true, 0.5}};
    const std::string csv = point_csv(sweep, make_points(sweep));
    CHECK(count(csv, ",50,,,,,,,,,\r\n") == 1);
    CHECK(count(csv, ",0,,,,,,,,,\r\n") == 3);
}

TEST_CASE("of very many warnings the first two hundred are listed", "[sweep]") {
    Sweep sweep;
    sweep.runs.resize(70);
    for (SweepRun& run : sweep.runs) {
        run.name = "run";
        run.summary = *make_folder().summary;
        run.summary->warnings = {{"a", true, 0.1}, {"b", true, 0.1}, {"c", true, 0.1}};
    }
    const std::string list = affected_section(sweep, "sweep.html");
    CHECK(count(list, "<li>run: ") == 200);
    CHECK_THAT(list, Catch::Contains("<li>and 10 more: see the reports of the runs</li>"));
}

TEST_CASE("an interval of two runs says so", "[sweep]") {
    const TempFolder folder;
    for (const int seed : {1, 2})
        for (const double speed : {0.5, 1.0})
            write_run(folder / fmt::format("u{}s{}", speed, seed), speed, 0.1, seed,
                      1000.0 * speed + seed);
    const Sweep sweep = read_sweep(folder.path());
    const std::string text = sweep_markdown(sweep);
    CHECK_THAT(text, Catch::Contains("| 502 \u00b1 6 (n = 2, t = 12.7) |"));
    CHECK_THAT(text, Catch::Contains("\n\nn = 2, t = 12.7: a 95 % interval of two runs is 12.7 "
                                     "standard errors"));
    write_run(folder / "u0.5s3", 0.5, 0.1, 3, 503.0);
    write_run(folder / "u1s3", 1.0, 0.1, 3, 1003.0);
    CHECK_THAT(sweep_markdown(read_sweep(folder.path())), !Catch::Contains("n = 2"));
    CHECK_THAT(make_sweep_curve(sweep), Catch::Contains(">two runs: t = 12.7</text>"));
}

namespace {

// two speeds in level ice, with parts, formulas and cracks
void write_level_runs(const TempFolder& folder) {
    for (const double speed : {1.0, 2.0}) {
        const auto run = folder / fmt::format("u{}", speed);
        write_run(run, speed, 0.1, 1, 1000.0 * speed);
        Summary s = read_summary(run / "summary.json");
        s.ice.hold = {"until-bent", "always"};
        s.resistance.breaking_mean = 300.0 * speed;
        s.resistance.submersion_mean = 700.0 * speed;
        s.ice.flexural_strength = 4.5e5;
        s.ice.bending_model = "wedge";
        s.ice.bending_factor = 1.5;
        s.cracks = CrackParticulars{.pieces = 235.0,
                                    .radius = 2.0 * speed,
                                    .characteristic_length = 8.0,
                                    .thickness = 0.5,
                                    .opening_deg = 134.0,
                                    .load = 1.15e5,
                                    .channel_breadth = 16.0};
        s.formulas = {{"Lindqvist 1989", "submersion", 500.0, false},
                      {"Lindqvist 1989", "crushing", 400.0, false},
                      {"Lindqvist 1989", "bending", 200.0, false},
                      {"Lindqvist 1989", "total", 1100.0, false},
                      {"Riska 1997", "total", 1500.0, false},
                      {"Jeong 2010", "buoyancy", 150.0, false},
                      {"Jeong 2010", "clearing", 100.0, false},
                      {"Jeong 2010", "buoyancy + clearing", 250.0, false},
                      {"Jeong 2010", "breaking", 1050.0, true},
                      {"Jeong 2010", "total", 1300.0, true}};
        write_bytes(run / "summary.json", summary_text(s));
    }
}

}  // namespace

TEST_CASE("in level ice the parts' chart has breaking and submersion, the formulas' beside them",
          "[sweep]") {
    const TempFolder folder;
    write_level_runs(folder);
    const Sweep sweep = read_sweep(folder.path());
    const auto curves = make_curves(sweep, make_points(sweep));
    const auto charts = draw_parts(sweep, curves, choose_sweep_unit(curves[0].points), 600.0);
    REQUIRE(charts.size() == 1);
    for (const char* legend :
         {">resistance<", ">breaking<", ">submersion and all else<", ">formulas, total<",
          ">Lindqvist, crushing + bending<", ">Lindqvist, submersion<", ">Jeong, breaking<",
          ">Jeong, buoyancy + clearing<"}) {
        CAPTURE(legend);
        CHECK(count(charts[0], legend) == 1);
    }
    // a dozen curves cannot be read: no regions of the hull, and no total of a formula
    for (const char* legend :
         {">bow<", ">friction<", ">Riska<", ">Lindqvist<", ">Jeong, buoyancy<"})
        CHECK(count(charts[0], legend) == 0);
    const auto parts = component_curves(curves[0]);
    REQUIRE(parts.size() == 2);
    CHECK(value_at(curves[0].points[0], parts[0]) == 600.0);  // crushing and bending
    CHECK(value_at(curves[0].points[0], parts[1]) == 1050.0);
}

TEST_CASE("a sweep in level ice says so, and has bending, cracks and channel", "[sweep]") {
    const TempFolder folder;
    write_level_runs(folder);
    const Sweep sweep = read_sweep(folder.path());
    CHECK_THAT(point_csv(sweep, make_points(sweep)),
               Catch::Contains(",300,,700,,2,0.25,4,134,16\r\n"));
    const std::string page = make_sweep_page(sweep, folder / "sweep.html");
    CHECK_THAT(page, Catch::Contains("crack in characteristic lengths (ships: 0.1 to 0.4)") &&
                         Catch::Contains("<td>0.50</td><td>8.0</td><td>134</td><td>16.0</td>"));
    CHECK_THAT(page, Catch::Contains("Ice resistance of a ship in level ice, simulated"));
    CHECK_THAT(sweep_markdown(sweep), Catch::Contains("| Lindqvist [N] | Riska [N] | Jeong [N] |"));
    // beside broken ice a formula has two columns, and each names its part
    write_run(folder / "broken", 1.5, 0.1, 1, 500.0);
    CHECK_THAT(sweep_markdown(read_sweep(folder.path())),
               Catch::Contains("| Lindqvist, total [N] | Riska [N] | Jeong, total [N] | Lindqvist, "
                               "submersion [N] | Jeong, buoyancy + clearing [N] |"));
    CHECK_THAT(head_facts(sweep), Catch::Contains("level ice, thickness 0.2 m") &&
                                      Catch::Contains("flexural strength 450 kPa") &&
                                      Catch::Contains("bending model wedge, factor on the "
                                                      "breaking load 1.5"));
}

TEST_CASE("tables show a speed given in knots with six digits, CSV with all", "[sweep]") {
    const TempFolder folder;
    const double six_knots = 6.0 * 1852.0 / 3600.0;
    write_run(folder / "slow", 0.5, 0.1, 1, 500.0);
    write_run(folder / "fast", six_knots, 0.1, 1, 900.0);
    const Sweep sweep = read_sweep(folder.path());
    CHECK_THAT(sweep_markdown(sweep), Catch::Contains("| 3.08667 |"));
    CHECK_THAT(point_csv(sweep, make_points(sweep)),
               Catch::Contains(fmt::format("{},", six_knots)));
}

TEST_CASE("runs in 3D and in 2D share no chart, no table and no column", "[sweep]") {
    const TempFolder folder;
    for (const double speed : {0.5, 1.0})
        for (const int dimension : {2, 3}) {
            const auto run = folder / fmt::format("d{}u{}", dimension, speed);
            write_run(run, speed, 0.1, 1, 1000.0 * dimension,
                      fmt::format("[extra]\ndimension = {}\n", dimension));
            Summary s = read_summary(run / "summary.json");
            s.dimension = dimension;
            write_bytes(run / "summary.json", summary_text(s));
        }
    const auto parts = split_sweep(read_sweep(folder.path()));
    REQUIRE(parts.size() == 2);
    for (const Sweep& part : parts) {
        CHECK(part.runs.size() == 2);
        CHECK(part.axes == std::vector<std::string>{"hull.speed"});  // no longer the dimension
    }
    CHECK(dimension_of(parts[0]) == 3);
    CHECK_THAT(make_sweep_curve(parts[0]), Catch::Contains("resistance [N]"));
    CHECK_THAT(make_sweep_curve(parts[1]), Catch::Contains("resistance [N/m]"));
    CHECK_THAT(point_csv(parts[1], make_points(parts[1])),
               Catch::Contains("resistance_N_per_m,resistance_ci95_N_per_m"));
    CHECK_THAT(run_csv(parts[1]), Catch::Contains(",ci95_N_per_m,"));
    const std::string text = sweep_markdown(read_sweep(folder.path()));
    CHECK(count(text, "resistance [N] |") == 1);
    CHECK(count(text, "resistance [N/m] |") == 1);
    const std::string page = make_sweep_page(read_sweep(folder.path()), folder / "sweep.html");
    CHECK(tag_fault(markup_of(page)).empty());
    for (const char* id : {"part-2d", "part-3d", "curve-2d", "curve-3d", "points-2d", "points-3d"})
        CHECK(count(page, fmt::format("id=\"{}\"", id)) == 1);
}

TEST_CASE("a run's report links to the sweep above it, one by itself to none", "[sweep][report]") {
    const TempFolder folder;
    read::RunFolder run = make_folder();
    run.path = folder / "runs/u=1";
    std::filesystem::create_directories(run.path);
    const auto page = [&](const std::filesystem::path& file) {
        report::write_report(run, file);
        return read_bytes(file);
    };
    CHECK_THAT(page(run.path / "report.html"), !Catch::Contains("sweep.html"));
    write_bytes(folder / "runs.toml", "");
    CHECK_THAT(page(run.path / "report.html"), Catch::Contains("href=\"../../sweep.html\""));
    write_bytes(folder / "runs/sweep.html", "");
    CHECK_THAT(page(run.path / "report.html"), Catch::Contains("href=\"../sweep.html\""));
    CHECK_THAT(page(folder / "elsewhere.html"), !Catch::Contains("sweep.html"));
}

TEST_CASE("the head of a sweep tells ship, ice and speeds that the summaries have", "[sweep]") {
    const TempFolder folder;
    for (const double speed : {0.5, 1.0}) {
        const auto run = folder / fmt::format("u{}", speed);
        write_run(run, speed, 0.1, 1, 100.0);
        std::string text = summary_text(read_summary(run / "summary.json"));
        // whatever the fixture has of its own goes out of the way
        for (const std::string key : {"\n  \"ship\"", "\n  \"ice\""})
            if (const auto at = text.find(key); at != std::string::npos)
                text.replace(at, key.size(), "\n  \"old\"");
        text.insert(1, fmt::format("\"ship\": {{\"length_m\": 10, \"breadth_m\": 2}}, "
                                   "\"ice\": {{\"thickness_m\": {}, \"concentration\": 0.8, "
                                   "\"crushing_pressure_Pa\": 1e6}},",
                                   0.1 * speed));
        write_bytes(run / "summary.json", text);
    }
    const std::string head = head_facts(read_sweep(folder.path()));
    CHECK_THAT(head, Catch::Contains("L 10 m, B 2 m</td>"));
    CHECK_THAT(head, Catch::Contains("thickness 0.05 to 0.1 m, concentration 80 %, crushing "
                                     "pressure 1 MPa"));
    CHECK_THAT(head, Catch::Contains("0.5 to 1 m/s (0.97 to 1.94 kn)"));
}

TEST_CASE("curves with long names are told apart by the values of the only other axis", "[sweep]") {
    const TempFolder folder;
    for (const double speed : {0.5, 1.0})
        for (const double mu : {0.05, 0.1, 0.15, 0.2})
            write_run(folder / fmt::format("u{}m{}", speed, mu), speed, mu, 1, 100.0 * speed + mu);
    const std::string curve = make_sweep_curve(read_sweep(folder.path()));
    CHECK_THAT(curve, Catch::Contains("Resistance by friction ship-ice"));
    CHECK_THAT(curve, Catch::Contains(">0.15</text>"));
}

TEST_CASE("sweeps over texts or nothing have tables without curves", "[sweep]") {
    const TempFolder folder;
    write_run(folder / "a", 0.5, 0.1, 1, 500.0, "normal = \"surface\"\nlist = [0.49, 1]\n");
    write_run(folder / "b", 0.5, 0.1, 1, 700.0, "normal = \"centres\"\nlist = [0.49, 1.0]\n");
    const Sweep sweep = read_sweep(folder.path());
    CHECK(sweep.x.empty());
    CHECK(sweep.axes == std::vector<std::string>{"contact.normal"});
    CHECK(sweep.runs[0].text("contact.list") == "[0.49, 1]");
    const std::string page = make_sweep_page(sweep, folder / "sweep.html");
    CHECK(tag_fault(markup_of(page)).empty());
    CHECK_THAT(page, Catch::Contains("there is no curve to draw"));
    CHECK_THAT(page, Catch::Contains("centres"));

    std::filesystem::remove_all(folder / "b");
    CHECK(tag_fault(markup_of(make_sweep_page(read_sweep(folder.path()), folder / "s.html")))
              .empty());
    std::filesystem::remove(folder / "a/summary.json");
    CHECK(tag_fault(markup_of(make_sweep_page(read_sweep(folder.path()), folder / "s.html")))
              .empty());
}

TEST_CASE("no folder, no runs and faulty plans are one clear error each", "[sweep]") {
    const TempFolder folder;
    const auto complaint = [&] { return error_text([&] { read_sweep(folder.path()); }); };
    CHECK_THAT(error_text([&] { read_sweep(folder / "none"); }), Catch::Contains("not found"));
    CHECK_THAT(complaint(), Catch::Contains("holds no runs"));
    write_bytes(folder / "runs.toml", "axes = [");
    CHECK_THAT(complaint(), Catch::Contains("runs.toml:1:"));
    write_bytes(folder / "runs.toml", "title = \"x\"\n");
    CHECK_THAT(complaint(), Catch::Contains("plans no [[run]]"));
    write_bytes(folder / "runs.toml", "[[run]]\nvalues = {}\n");
    CHECK_THAT(complaint(), Catch::Contains("a run has no name"));
    write_bytes(folder / "runs.toml", "axes = [1]\n[[run]]\nname = \"a\"\n");
    CHECK_THAT(complaint(), Catch::Contains("axes is no text"));
}
