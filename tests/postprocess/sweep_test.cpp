// SPDX-License-Identifier: GPL-3.0-or-later
// Tolerances: 1e-6 and 1e-5 are the last digit of t in a table.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "postprocess/sweep/share_work.hpp"
#include "postprocess/sweep/sweep_markdown.hpp"
#include "postprocess/sweep/sweep_points.hpp"
#include "postprocess/sweep/sweep_tables.hpp"
#include "postprocess/sweep/write_sweep.hpp"
#include "tests/postprocess/write_runs.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using namespace ice::test;
using namespace ice::sweep;

TEST_CASE("the mean of 9, 10, 11 is 10 with a half width of 4.303 / sqrt(3)", "[sweep][analytic]") {
    const Estimate three = estimate_mean({9.0, 10.0, 11.0});
    CHECK(three.mean == Near(10.0));
    // t_{0.975, 2} = 4.30265 (tables), s = 1
    CHECK(three.half == Near(4.30265 / std::sqrt(3.0)).epsilon(1e-6));
    // two values: t_{0.975, 1} = 12.7062, s / sqrt(2) is half their distance
    CHECK(estimate_mean({1.0, 3.0}).half == Near(12.7062).epsilon(1e-5));
    CHECK(estimate_mean({5.0, 5.0, 5.0}).half == 0.0);
    CHECK(std::isnan(estimate_mean({5.0}).half));
    CHECK(std::isnan(estimate_mean({}).mean));
    CHECK(std::isnan(estimate_mean({1.0, std::nan("")}).mean));
}

TEST_CASE("regions of the hull belong to bow, sides, bottom or the rest by their names",
          "[sweep]") {
    for (const char* bow : {"bow", "Bow_port", "forefoot", "stem"})
        CHECK(part_of_region(bow) == Part::bow);
    for (const char* side : {"side", "SIDE.001", "shoulder"})
        CHECK(part_of_region(side) == Part::sides);
    for (const char* bottom : {"bottom", "bilge", "keel"})
        CHECK(part_of_region(bottom) == Part::bottom);
    for (const char* rest : {"hull", "deck", "propeller", "stern", ""})
        CHECK(part_of_region(rest) == Part::rest);
}

TEST_CASE("without a plan the resolved cases say what varies, and seeds become intervals",
          "[sweep]") {
    const TempFolder folder;
    write_grid(folder);
    const Sweep sweep = read_sweep(folder.path());
    CHECK(sweep.runs.size() == 12);
    CHECK(sweep.x == "hull.speed");
    // average_from varies with the speed, but no force depends on [output]
    CHECK(sweep.axes == std::vector<std::string>{"contact.friction_ship_ice", "hull.speed"});

    const auto points = make_points(sweep);
    REQUIRE(points.size() == 4);
    const Point& p = points.front();  // mu = 0.1, u = 0.5
    CHECK(p.runs.size() == 3);
    CHECK(p.part(Part::total).mean == Near(510.0));
    CHECK(p.part(Part::total).half == Near(4.30265 / std::sqrt(3.0)).epsilon(1e-6));
    CHECK(p.part(Part::bow).mean == Near(306.0));
    CHECK(p.part(Part::bottom).mean == Near(153.0));
    CHECK(p.part(Part::sides).mean == 0.0);
    CHECK(p.part(Part::rest).mean == Near(51.0));
    CHECK(p.part(Part::friction).mean == Near(102.0));
    CHECK(p.part(Part::bottom_contact).mean == Near(102.0));
    CHECK(p.part(Part::bottom_friction).mean == Near(51.0));
    CHECK(p.part(Part::rest_friction).mean == 0.0);
    CHECK(p.lindqvist == Near(550.0));
    for (const Point& point : points) {
        double sum = 0.0;
        for (const Part part : {Part::bow, Part::sides, Part::bottom, Part::rest})
            sum += point.part(part).mean;
        CHECK(sum == Near(point.part(Part::total).mean));
        sum = point.part(Part::friction).mean;
        for (const Part part :
             {Part::bow_contact, Part::sides_contact, Part::bottom_contact, Part::rest_contact})
            sum += point.part(part).mean;
        CHECK(sum == Near(point.part(Part::total).mean));
        CHECK(point.part(Part::bow_contact).mean + point.part(Part::bow_friction).mean ==
              Near(point.part(Part::bow).mean));
        CHECK(point.part(Part::contact).mean + point.part(Part::friction).mean ==
              Near(point.part(Part::total).mean));
    }

    const auto curves = make_curves(sweep, points);
    REQUIRE(curves.size() == 2);
    CHECK(curves[1].label == "friction ship-ice 0.2");
    CHECK(curves[1].points.size() == 2);
    CHECK(curves[1].points[1].part(Part::total).mean == Near(1020.0));
}

TEST_CASE("a single run has its own interval, and keys that follow the speed are no axes",
          "[sweep]") {
    const TempFolder folder;
    write_run(folder / "b", 1.0, 0.1, 0, 900.0, "restitution = 0.2\n");
    write_run(folder / "a", 0.5, 0.1, 0, 600.0, "restitution = 0.1\n");
    const Sweep sweep = read_sweep(folder.path());
    CHECK(sweep.axes == std::vector<std::string>{"hull.speed"});
    CHECK(sweep.tied == std::vector<std::string>{"contact.restitution"});
    const auto points = make_points(sweep);
    REQUIRE(points.size() == 2);
    CHECK(points[0].part(Part::total).mean == 600.0);
    CHECK(points[0].part(Part::total).half == 7.0);  // summary.json's ci95_N
    CHECK(std::isnan(points[0].part(Part::bow).half));
    CHECK_THAT(make_sweep_page(sweep, folder / "sweep.html"),
               Catch::Contains("Varying with it: contact.restitution"));
}

TEST_CASE("summaries from before the split have parts without contact and friction", "[sweep]") {
    const TempFolder folder;
    for (const double speed : {0.5, 1.0}) {
        const auto run = folder / fmt::format("u{}", speed);
        write_run(run, speed, 0.1, 1, 500.0);
        std::string text = summary_text(read_summary(run / "summary.json"));
        const std::size_t regions = text.find("\"regions\"");
        for (const std::string key : {"\"contact_mean_N\"", "\"friction_mean_N\""})
            for (std::size_t at = text.find(key, regions); at != std::string::npos;
                 at = text.find(key, at))
                text.replace(at, key.size(), "\"unknown\"");
        write_bytes(run / "summary.json", text);
    }
    const Sweep sweep = read_sweep(folder.path());
    const auto points = make_points(sweep);
    REQUIRE(points.size() == 2);
    CHECK(points[0].part(Part::bow).mean == Near(300.0));
    CHECK(std::isnan(points[0].part(Part::bow_friction).mean));
    const std::string page = make_sweep_page(sweep, folder / "sweep.html");
    CHECK(tag_fault(markup_of(page)).empty());
    CHECK_THAT(page, !Catch::Contains("bow, friction"));  // a column of nothing
    CHECK_THAT(point_csv(sweep, points), !Catch::Contains("nan"));
}

TEST_CASE("runs that failed, never began or cannot be read become rows with a reason", "[sweep]") {
    const TempFolder folder;
    write_run(folder / "runs/u=0.5", 0.5, 0.1, 1, 500.0);
    write_run(folder / "runs/u=1", 1.0, 0.1, 1, 700.0);
    write_run(folder / "runs/old", 9.0, 0.1, 1, 1.0);
    std::filesystem::create_directories(folder / "runs/bad");
    write_bytes(folder / "runs/bad/summary.json", "{\"schema\": ");
    Summary stopped = *make_folder().summary;
    stopped.status = "interrupted";
    std::filesystem::create_directories(folder / "runs/stopped");
    write_bytes(folder / "runs/stopped/summary.json", summary_text(stopped));
    std::filesystem::create_directories(folder / "logs");
    write_bytes(folder / "logs/u=-1.log",
                "icesolve: error: case.cfg: 1 mistake\n--set: error: hull.speed = -1 <low>\n");
    std::string plan = "title = \"A & B\"\naxes = [\"hull.speed\", \"simulation.seed\"]\n";
    for (const char* name : {"u=0.5", "u=1", "u=-1", "u=2", "bad", "stopped"})
        plan += fmt::format("[[run]]\nname = \"{}\"\nvalues = {{\"hull.speed\" = 3}}\n", name);
    write_bytes(folder / "runs.toml", plan);

    const Sweep sweep = read_sweep(folder.path());
    REQUIRE(sweep.runs.size() == 6);
    CHECK(sweep.runs[0].summary);
    CHECK(sweep.runs[0].text("hull.speed") == "0.5");  // the case's, not the plan's
    CHECK(sweep.runs[2].status == "failed");
    CHECK(sweep.runs[2].fault == "--set: error: hull.speed = -1 <low>");
    CHECK(sweep.runs[3].status == "not run");
    CHECK(sweep.runs[4].status == "unreadable");
    CHECK_THAT(sweep.runs[4].fault, Catch::Contains("is not valid JSON"));
    CHECK(sweep.runs[5].status == "interrupted");
    REQUIRE(sweep.warnings.size() == 1);
    CHECK_THAT(sweep.warnings[0], Catch::Contains("runs/old is not in runs.toml"));
    CHECK(make_points(sweep).size() == 2);
    CHECK_THAT(list_faults(sweep), Catch::StartsWith("4 of 6 runs have no result: u=-1; u=2; "));

    const std::string page = make_sweep_page(sweep, folder / "sweep.html");
    CHECK(tag_fault(markup_of(page)).empty());
    CHECK_THAT(page, Catch::Contains("2 of 6 runs completed"));
    CHECK_THAT(page, Catch::Contains("A &amp; B"));
    CHECK_THAT(page, Catch::Contains("hull.speed = -1 &lt;low&gt;"));
    CHECK_THAT(page, Catch::Contains("href=\"runs/u%3D0.5\""));
    // one file that loads nothing
    for (const char* loading : {"<script src", "<img", "<link", "@import"})
        CHECK(page.find(loading) == std::string::npos);
}

TEST_CASE("of many runs without a result the first twelve are named", "[sweep]") {
    Sweep sweep;
    sweep.runs.resize(15);
    for (std::size_t k = 0; k < 15; ++k) sweep.runs[k].name = fmt::format("run{}", k + 1);
    const std::string text = list_faults(sweep);
    CHECK_THAT(text, Catch::StartsWith("15 of 15 runs have no result: run1; ") &&
                         Catch::EndsWith("; run12; ..."));
    const std::string page = make_sweep_page(sweep, "sweep.html");
    CHECK_THAT(page, Catch::Contains("<li>run12: ") && !Catch::Contains("<li>run13: ") &&
                         Catch::Contains("and 3 more: see"));
}

TEST_CASE("members of an ensemble count once, whatever their seeds changed", "[sweep]") {
    const TempFolder folder;
    for (const double speed : {0.5, 1.0}) {
        const auto parent = folder / fmt::format("u{}", speed);
        for (const int seed : {1, 2, 3})
            write_run(parent / fmt::format("seed-{}", seed), speed, 0.1, seed, 1000.0 + seed,
                      fmt::format("[field]\nfile = \"fields/{}.h5\"\n", seed));
        Summary s = *make_folder().summary;
        s.ensemble = Ensemble{1002.0, 2.5, {1001.0, 1002.0, 1003.0}, {1, 2, 3}};
        write_bytes(parent / "summary.json", summary_text(s));
    }
    const Sweep sweep = read_sweep(folder.path());
    CHECK(sweep.runs.size() == 6);
    CHECK(sweep.axes == std::vector<std::string>{"hull.speed"});
    const auto points = make_points(sweep);
    REQUIRE(points.size() == 2);
    CHECK(points[0].runs.size() == 3);
    CHECK(points[0].part(Part::total).mean == Near(1002.0));
    CHECK(read_sweep(folder / "u0.5").runs.size() == 3);
}

TEST_CASE("the ship's work is shared out per metre of travel", "[sweep][analytic]") {
    const TempFolder folder;
    write_grid(folder);
    Sweep sweep = read_sweep(folder.path());
    for (SweepRun& run : sweep.runs) {
        run.summary->simulated_s = 20.0;
        run.summary->energy = {
            {"ship_work_J", 5000.0}, {"potential_J", 3000.0},    {"kinetic_change_J", 0.0},
            {"friction_J", 1500.0},  {"restitution_J", 400.0},   {"crushing_J", 0.0},
            {"drag_J", 200.0},       {"buoyancy_moment_J", 0.0}, {"separation_J", 100.0}};
    }
    const auto points = make_points(sweep);
    const auto shares = share_work(sweep, points.front());  // 0.5 m/s: 10 m
    CHECK(shares.front().force == Near(500.0));
    double sum = 0.0;
    for (const WorkShare& share : shares) sum += share.force;
    CHECK(sum == Near(1000.0));  // the work and what became of it

    const std::string text = sweep_markdown(sweep);
    CHECK_THAT(
        text, Catch::StartsWith("| friction ship-ice | speed [m/s] | runs | resistance [N] |"
                                " bow [N] | bottom [N] | rest [N] | friction [N] | "
                                "largest [N] | Lindqvist [N] | Jeong [N] | release rule |\n|---|"));
    CHECK_THAT(
        text,
        Catch::Contains("\n| 0.1 | 0.5 | 3 | 510 \u00b1 2 | 255 | 102 | 51 | 102 | 2 | 550 | 240 | "
                        "until-hull-contact |\n"));
    CHECK_THAT(text, Catch::Contains("\n| 0.1 | 0.5 | 500 | 300 | 150 | 40 | 20 | -10 |\n"));
    CHECK_THAT(make_sweep_curve(sweep), Catch::StartsWith("<svg xmlns"));

    // a speed that changes leaves the travel unknown
    for (SweepRun& run : sweep.runs) run.settings.erase(kSpeedKey);
    CHECK(std::isnan(share_work(sweep, points.front()).front().force));
}
