// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "postprocess/report/write_report.hpp"
#include "postprocess/sweep/share_work.hpp"
#include "postprocess/sweep/split_sweep.hpp"
#include "postprocess/sweep/sweep_head.hpp"
#include "postprocess/sweep/sweep_markdown.hpp"
#include "postprocess/sweep/sweep_points.hpp"
#include "postprocess/sweep/sweep_tables.hpp"
#include "postprocess/sweep/write_sweep.hpp"
#include "tests/postprocess/make_folder.hpp"

using namespace ice;
using namespace ice::test;
using namespace ice::sweep;

namespace {

// A run folder at u with the resistance given, of which the bow has 60 %, the bottom 30 %; 10 % are
// friction on each.
void write_run(const std::filesystem::path& folder, double speed, double mu, int seed,
               double resistance, const std::string& more = "") {
    std::filesystem::create_directories(folder);
    Summary s = *make_folder().summary;
    s.resistance = {resistance, 0.8 * resistance, 0.2 * resistance, 1.0, 2.0, 7.0};
    s.lindqvist_submersion = 500.0 + 100.0 * speed;
    s.regions.clear();
    const auto add = [&](const char* region, double contact, double friction) {
        const auto force = [&](double share) {
            return std::array<double, 3>{-share * resistance, 0.0, 1.0};
        };
        s.regions[region] = {1, 1.0, force(contact + friction), force(contact), force(friction)};
    };
    add("bow", 0.5, 0.1);
    add("Bottom_aft", 0.2, 0.1);
    add("hull", 0.1, 0.0);
    write_bytes(folder / "summary.json", summary_text(s));
    write_bytes(folder / "case.resolved.cfg",
                fmt::format("title = \"t{}\"\n[simulation]\nseed = {}\n[hull]\nspeed = {}\n"
                            "spheres = \"/a/b/hull.spheres.h5\"\n[contact]\n"
                            "friction_ship_ice = {}\n{}[output]\naverage_from = {}\n",
                            speed, seed, speed, mu, more, 10.0 * speed));
}

// Two speeds, two frictions, three seeds: resistance 1000 u + 100 mu + {-1, 0, 1}.
void write_grid(const TempFolder& folder) {
    for (const double speed : {0.5, 1.0})
        for (const double mu : {0.1, 0.2})
            for (const int seed : {1, 2, 3})
                write_run(folder / fmt::format("runs/u{}m{}s{}", speed, mu, seed), speed, mu, seed,
                          1000.0 * speed + 100.0 * mu + seed - 2.0);
}

}  // namespace

TEST_CASE("the mean of 9, 10, 11 is 10 with a half width of 4.303 / sqrt(3)", "[sweep]") {
    const Estimate three = estimate_mean({9.0, 10.0, 11.0});
    CHECK(three.mean == Approx(10.0));
    // t_{0.975, 2} = 4.30265 (tables), s = 1
    CHECK(three.half == Approx(4.30265 / std::sqrt(3.0)).epsilon(1e-6));
    // two values: t_{0.975, 1} = 12.7062, s / sqrt(2) is half their distance
    CHECK(estimate_mean({1.0, 3.0}).half == Approx(12.7062).epsilon(1e-5));
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
    CHECK(p.part(Part::total).mean == Approx(510.0));
    CHECK(p.part(Part::total).half == Approx(4.30265 / std::sqrt(3.0)).epsilon(1e-6));
    CHECK(p.part(Part::bow).mean == Approx(306.0));
    CHECK(p.part(Part::bottom).mean == Approx(153.0));
    CHECK(p.part(Part::sides).mean == 0.0);
    CHECK(p.part(Part::rest).mean == Approx(51.0));
    CHECK(p.part(Part::friction).mean == Approx(102.0));
    CHECK(p.part(Part::bottom_contact).mean == Approx(102.0));
    CHECK(p.part(Part::bottom_friction).mean == Approx(51.0));
    CHECK(p.part(Part::rest_friction).mean == 0.0);
    CHECK(p.lindqvist == Approx(550.0));
    for (const Point& point : points) {
        double sum = 0.0;
        for (const Part part : {Part::bow, Part::sides, Part::bottom, Part::rest})
            sum += point.part(part).mean;
        CHECK(sum == Approx(point.part(Part::total).mean));
        sum = point.part(Part::friction).mean;
        for (const Part part :
             {Part::bow_contact, Part::sides_contact, Part::bottom_contact, Part::rest_contact})
            sum += point.part(part).mean;
        CHECK(sum == Approx(point.part(Part::total).mean));
        CHECK(point.part(Part::bow_contact).mean + point.part(Part::bow_friction).mean ==
              Approx(point.part(Part::bow).mean));
        CHECK(point.part(Part::contact).mean + point.part(Part::friction).mean ==
              Approx(point.part(Part::total).mean));
    }

    const auto curves = make_curves(sweep, points);
    REQUIRE(curves.size() == 2);
    CHECK(curves[1].label == "friction ship-ice 0.2");
    CHECK(curves[1].points.size() == 2);
    CHECK(curves[1].points[1].part(Part::total).mean == Approx(1020.0));
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
    CHECK(points[0].part(Part::bow).mean == Approx(300.0));
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

    const std::string csv = point_csv(sweep, make_points(sweep));
    CHECK(count(csv, "\r\n") == 5);
    CHECK_THAT(csv, Catch::StartsWith("contact.friction_ship_ice,hull.speed,runs,resistance_N,"
                                      "resistance_ci95_N,bow_N,"));
    CHECK_THAT(csv, Catch::Contains("\r\n0.1,0.5,3,510,"));
    CHECK_THAT(csv, Catch::Contains(",hold\r\n") && Catch::Contains(",until-hull-contact\r\n"));
    CHECK_THAT(page, Catch::Contains("<th scope=\"col\">release rule</th>"));
    CHECK(count(run_csv(sweep), "\r\n") == 13);
    CHECK(encode_address("a b/c=1,2%\u00e4") == "a%20b/c%3D1%2C2%25%C3%A4");
}

TEST_CASE("an interval of two runs says so", "[sweep]") {
    const TempFolder folder;
    for (const int seed : {1, 2})
        for (const double speed : {0.5, 1.0})
            write_run(folder / fmt::format("u{}s{}", speed, seed), speed, 0.1, seed,
                      1000.0 * speed + seed);
    const Sweep sweep = read_sweep(folder.path());
    CHECK_THAT(sweep_markdown(sweep), Catch::Contains("| 502 \u00b1 6 (n = 2, t = 12.7) |"));
    CHECK_THAT(make_sweep_curve(sweep), Catch::Contains(">two runs: t = 12.7</text>"));
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
    for (const char* id : {"curve-2d", "curve-3d", "points-2d", "points-3d"})
        CHECK(count(page, fmt::format("id=\"{}\"", id)) == 1);
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
    CHECK(points[0].part(Part::total).mean == Approx(1002.0));
    CHECK(read_sweep(folder / "u0.5").runs.size() == 3);
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

TEST_CASE("the ship's work is shared out per metre of travel", "[sweep]") {
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
    CHECK(shares.front().force == Approx(500.0));
    double sum = 0.0;
    for (const WorkShare& share : shares) sum += share.force;
    CHECK(sum == Approx(1000.0));  // the work and what became of it

    const std::string text = sweep_markdown(sweep);
    CHECK_THAT(text, Catch::StartsWith("| friction ship-ice | speed [m/s] | runs | resistance [N] |"
                                       " bow [N] | bottom [N] | rest [N] | friction [N] | "
                                       "largest [N] | Lindqvist [N] | release rule |\n|---|"));
    CHECK_THAT(
        text, Catch::Contains("\n| 0.1 | 0.5 | 3 | 510 \u00b1 2 | 255 | 102 | 51 | 102 | 2 | 550 | "
                              "until-hull-contact |\n"));
    CHECK_THAT(text, Catch::Contains("\n| 0.1 | 0.5 | 500 | 300 | 150 | 40 | 20 | -10 |\n"));
    CHECK_THAT(make_sweep_curve(sweep), Catch::StartsWith("<svg xmlns"));

    // a speed that changes leaves the travel unknown
    for (SweepRun& run : sweep.runs) run.settings.erase(kSpeedKey);
    CHECK(std::isnan(share_work(sweep, points.front()).front().force));
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
