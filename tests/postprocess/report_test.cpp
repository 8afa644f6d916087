// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "common/base/uncertainty.hpp"
#include "postprocess/report/sections.hpp"
#include "postprocess/report/tables.hpp"
#include "postprocess/report/write_report.hpp"
#include "tests/postprocess/make_folder.hpp"

using namespace ice;
using namespace ice::test;
using namespace ice::report;

namespace {

constexpr std::size_t kTwoMegabytes = 2000000;

// text of an element of the page
std::string element_text(const std::string& html, const std::string& opening) {
    const std::size_t at = html.find(opening);
    REQUIRE(at != std::string::npos);
    const std::size_t begin = html.find('>', at) + 1;
    return html.substr(begin, html.find("</", begin) - begin);
}

}  // namespace

TEST_CASE("the report of a 3D run contains its numbers, pictures and origin", "[report]") {
    const std::string html = make_report(make_folder());
    for (const char* text : {"1107 \u00b1 12",
                             "1006",
                             "101",
                             "1320",
                             "954",
                             "Lindqvist 1989, submersion part",  // forces
                             "bottom",
                             "37",
                             "8.25",
                             "-777",
                             "Lateral",                                     // regions
                             "a floe &lt;7&gt; left the field &amp; sank",  // warnings
                             "From below, t = ",
                             "From above, t = ",
                             "From starboard, t = ",
                             "From ahead, t = ",
                             "Force of the ice on the ship, x",
                             "Floe 6 on the ship, contact",  // charts
                             "density = 900.0",
                             "icesolve box.cfg --out box",
                             "abc123",
                             "Where the ship's work went",
                             "17.50",  // % of the work lost to drag
                             "-0.07",
                             "completed",
                             "8.00 m",
                             "0.200 m",
                             "1.25 MPa",
                             "until-hull-contact",  // ship and ice
                             "1.00 m/s = 1.94 kn",
                             "0.56 lengths",
                             "\u00b1 111 N",  // 10 % of the mean
                             "1107 W",        // at 1 m/s
                             "923",
                             "Resistance by region",
                             "Moments of the ice on the ship",
                             "Peaks of the force on a region",
                             "Largest pressure on each panel"}) {
        CAPTURE(text);
        CHECK(html.find(text) != std::string::npos);
    }
    CHECK_THAT(html, Catch::Contains("Box among floes &lt;test &amp; &quot;quotes&quot;&gt;"));
    CHECK(html.size() < kTwoMegabytes);
}

TEST_CASE("a report in ice that breaks gives the error against model tests in place of 10 %",
          "[report]") {
    read::RunFolder folder = make_folder();
    using Rules = std::vector<std::string>;
    for (const Rules& hold : {Rules{"until-bent", "always"}, Rules{"until-bent"}}) {
        folder.summary->ice.hold = hold;
        const std::string html = make_report(folder);
        CHECK_THAT(html, Catch::Contains("<b>6 to 45 %</b>") &&
                             Catch::Contains("bias +7 % over the seven tests of MT Uikku "
                                             "(docs/validation-measured.md)") &&
                             Catch::Contains("6 to 45 % against model tests in level ice, is not "
                                             "in it"));
        CHECK_THAT(html, !Catch::Contains("uncertainty of the model"));
        CHECK_THAT(html, !Catch::Contains("\u00b1 111 N"));  // 10 % of the mean
    }
    folder.summary->ice.hold = {"never", "always"};
    CHECK_THAT(make_report(folder), Catch::Contains("uncertainty of the model, 10 %") &&
                                        Catch::Contains("uncertainty of the model, about 10 %") &&
                                        !Catch::Contains("MT Uikku"));
}

TEST_CASE("the sentence on the ship's work names the entries that put energy in", "[report]") {
    Summary s = *make_folder().summary;
    CHECK(energy_balance(s) == "Work of the ship = the sum of all entries below them.");
    s.energy["separation_J"] = 1.0;
    s.energy["water_work_J"] = 100.0;
    CHECK(energy_balance(s) ==
          "Work of the ship + opened overlaps + moving water = the sum of all entries below them.");
    s.energy["drift_work_J"] = 12.0;
    s.energy["applied_work_J"] = 3.0;
    CHECK(energy_balance(s) ==
          "Work of the ship + drifting ice + opened overlaps + moving water + applied loads = the "
          "sum of all entries below them.");
    // the entries of the sentence are the first rows of the table
    const std::string table = energy_table(s);
    std::size_t at = 0;
    for (const char* row : {"Work of the ship", "drifting ice", "opening overlaps", "moving water",
                            "applied loads", "Lost to drag", "Not explained"}) {
        CAPTURE(row);
        at = table.find(row, at);
        REQUIRE(at != std::string::npos);
    }
}

TEST_CASE("single hits are the contact force without friction, and the page says so", "[report]") {
    read::RunFolder folder = make_folder();
    for (HistoryRow& row : folder.data.history) {
        row.contact_force = {-200.0F, 30.0F, 40.0F};
        row.friction_force = {-700.0F, 5.0F, 6.0F};
    }
    CHECK_THAT(make_report(folder),
               Catch::Contains("Single hits of the contact force, without friction, reach x 200, "
                               "y 30, z 40 N."));
}

TEST_CASE("the report's head has the half entrance angle and release rules in words", "[report]") {
    read::RunFolder folder = make_folder();
    folder.summary->ship.entrance_angle_deg = 28.0;
    folder.summary->ice.hold = {"never", "always"};
    const std::string html = make_report(folder);
    CHECK_THAT(html, Catch::Contains("Half entrance angle") && Catch::Contains("28.0 \u00b0"));
    // once as a card, once among the particulars
    CHECK(count(markup_of(html), "never (loose), always (unbroken)") == 2);
}

TEST_CASE("the report in level ice names its ice, its cracks and its bending", "[report]") {
    read::RunFolder folder = make_folder();
    Summary& s = *folder.summary;
    CHECK_THAT(make_report(folder), !Catch::Contains("Ice resistance of a ship in level ice") &&
                                        !Catch::Contains("Flexural strength") &&
                                        !Catch::Contains("in the scene at the end"));
    s.ice.hold = {"until-bent", "always"};
    s.ice.floes = 133;
    s.ice.flexural_strength = 4.5e5;
    s.ice.elastic_modulus = 5e9;
    s.ice.bending_model = "wedge";
    s.ice.bending_factor = 1.5;
    s.ship.breadth = 14.0;
    s.cracks = CrackParticulars{.pieces = 235.0,
                                .radius = 2.8,
                                .characteristic_length = 10.0,
                                .thickness = 0.6,
                                .opening_deg = 134.0,
                                .load = 1.15e5,
                                .channel_breadth = 16.1};
    const std::string html = make_report(folder);
    for (const char* text :
         {"Ice resistance of a ship in level ice, simulated", "<b>level ice, breaks by bending</b>",
          "release rule: until-bent, always", "Floes in the scene at the end", "450 kPa", "5 GPa",
          "Bending model", "Factor on the breaking load", "Pieces that broke off",
          "0.28 (ships: 0.1 to 0.4)", "4.7 (ships: 3 to 10)", "134 \u00b0", "115 kN",
          "16.1 m broad, 1.15 B"}) {
        CAPTURE(text);
        CHECK_THAT(html, Catch::Contains(text));
    }
}

TEST_CASE("whether the mean is steady is said in words of the force", "[report]") {
    read::RunFolder folder = make_folder();
    ForceStatistics& r = folder.summary->resistance;
    r.correlation_time = 0.2;
    r.effective_samples = 199.0;
    r.trend = -22.0;
    r.trend_significant = false;
    CHECK_THAT(make_report(folder),
               Catch::Contains("tells as much as 199 independent values; the interval is theirs") &&
                   Catch::Contains("the resistance falls by 22 N") &&
                   Catch::Contains("nothing speaks against a steady resistance"));
    r.trend = 300.0;
    r.trend_significant = true;
    CHECK_THAT(make_report(folder), Catch::Contains("the resistance rises by 300 N") &&
                                        Catch::Contains("the resistance is not steady"));
}

TEST_CASE("the counts of the solver stand beside what they mean for the mean", "[report]") {
    Summary s = *make_folder().summary;
    s.steps = 4572;
    s.unconverged_steps = 3448;
    s.max_overlap = 0.0095;
    s.residual_share = std::nan("");  // of an older program
    CHECK_THAT(numerics_table(s), Catch::Contains("3448 of 4572<") && Catch::Contains("9.5 mm<"));
    s.residual_share = 0.005;
    s.energy["separation_J"] = 0.0001 * s.energy.at("ship_work_J");
    CHECK_THAT(numerics_table(s),
               Catch::Contains("3448 of 4572; the impulses that they lack are 0.5 % of all: the "
                               "mean is hardly affected (it counts as affected from 2 % on)<") &&
                   Catch::Contains("9.5 mm; opening all overlaps added 0.01 % of the ship") &&
                   Catch::Contains("s work: the mean is hardly affected"));
    s.energy["separation_J"] = 0.03 * s.energy.at("ship_work_J");
    CHECK_THAT(numerics_table(s), Catch::Contains("added 3 % of the ship") &&
                                      Catch::Contains("s work: the mean is affected (it"));
    s.unconverged_steps = 0;
    CHECK_THAT(numerics_table(s), Catch::Contains("0 of 4572<"));
}

TEST_CASE("the errors in level ice are those of the page on measurements", "[report]") {
    std::ifstream file(ICE_SOURCE_DIR "/docs/validation-measured.md");
    const std::string page{std::istreambuf_iterator<char>(file), {}};
    // the tables' rows "| this program | mean absolute error | bias |"; the first one is of the
    // seven tests, the first four are MT Uikku's groups
    std::vector<std::pair<double, double>> rows;
    const std::string row = "| this program |";
    for (std::size_t at = page.find(row); at != std::string::npos && rows.size() < 4;
         at = page.find(row, at + 1)) {
        std::istringstream cells(page.substr(at + row.size(), 40));
        char bar = 0;
        rows.emplace_back();
        cells >> rows.back().first >> bar >> rows.back().second;
    }
    REQUIRE(rows.size() == 4);
    const auto [least, largest] = std::minmax_element(rows.begin(), rows.end());
    CHECK(std::lround(100.0 * kLeastLevelIceError) == std::lround(least->first));
    CHECK(std::lround(100.0 * kLargestLevelIceError) == std::lround(largest->first));
    CHECK(std::lround(100.0 * kLevelIceBias) == std::lround(rows[0].second));
}

TEST_CASE("the report of a 2D run is per metre, without lateral force and views from above",
          "[report]") {
    const std::string html = make_report(make_folder({.dimension = 2}));
    CHECK_THAT(html, Catch::Contains("N/m"));
    CHECK(html.find("Lateral") == std::string::npos);
    CHECK(html.find("From above") == std::string::npos);
    CHECK(count(html, "<title>From starboard, t = ") == 6);
}

TEST_CASE("the report's markup loads nothing and has all numbers without script", "[report]") {
    const std::string html = markup_of(make_report(make_folder()));
    for (const char* attribute : {"src=\"", "url(", "@import", "<link"}) {
        CAPTURE(attribute);
        CHECK(html.find(attribute) == std::string::npos);
    }
    CHECK(count(html, "href=\"") == count(html, "href=\"#"));
    // the only addresses are names of XML languages
    CHECK(count(html, "http") == count(html, "http://www.w3.org/"));
    CHECK_THAT(html, Catch::Contains("1107 \u00b1 12"));
    CHECK(count(html, "<svg") > 10);
}

TEST_CASE("every chart of the viewer has its place in the page, with a drawing", "[report]") {
    const std::string html = make_report(make_folder({.dimension = GENERATE(2, 3)}));
    const auto meta = nlohmann::json::parse(element_text(html, "id=\"run-meta\""));
    // resistance, axes, regions by axis, moments, coverage
    CHECK(meta["charts"].size() == (meta["dimension"] == 3 ? 9 : 7));
    for (const auto& chart : meta["charts"]) {
        const std::string holder = "data-chart=\"" + chart["id"].get<std::string>() + "\"><svg";
        CAPTURE(holder);
        CHECK(count(html, holder) == 1);
        for (const auto& curve : chart["series"])
            CHECK(meta["arrays"].contains(curve["array"].get<std::string>()));
    }
    CHECK(meta["frames"] == 45);
    CHECK(meta["floes"] == 6);
}

TEST_CASE("markers in a title are text like any other", "[report]") {
    read::RunFolder folder = make_folder();
    folder.data.header.title = "@BODY@ </script> @DATA@";
    const std::string html = make_report(folder);
    CHECK(element_text(html, "<h1") == "@BODY@ &lt;/script&gt; @DATA@");
    CHECK(count(html, "id=\"run-data\"") == 1);
    CHECK(tag_fault(markup_of(html)).empty());
}

TEST_CASE("names that a mesh or case brings along are text, whatever they look like",
          "[report][security]") {
    const std::string name = "<script>alert(1)</script><img src=x onerror='alert(2)'>";
    read::RunFolder folder = make_folder();
    folder.data.header.title = folder.summary->title = name;
    folder.summary->regions[name] = {1, 2.0, {3.0, 4.0, 5.0}};
    folder.summary->warnings = {{.text = name}};
    for (auto& shape : folder.data.header.shapes)
        for (std::string& region : shape.mesh.region_names) region = name;
    const std::string html = make_report(folder);
    CHECK(count(html, "<script>alert") == 0);
    CHECK(count(html, "<img src=x") == 0);
    CHECK(count(html, "&lt;script&gt;alert(1)") >= 3);  // title, region, warning
    CHECK(tag_fault(markup_of(html)).empty());
}

TEST_CASE("the report is well-formed and its ids are unique", "[report]") {
    const std::string html = make_report(make_folder({.dimension = GENERATE(2, 3)}));
    CHECK(tag_fault(markup_of(html)).empty());
    std::vector<std::string> ids;
    for (std::size_t at = html.find(" id=\""); at != std::string::npos;
         at = html.find(" id=\"", at + 1))
        ids.push_back(html.substr(at + 5, html.find('"', at + 5) - at - 5));
    std::sort(ids.begin(), ids.end());
    CHECK(std::adjacent_find(ids.begin(), ids.end()) == ids.end());
}

TEST_CASE("200 floes, all moving at random in all of 400 frames, give a report below 2 MB",
          "[report]") {
    // the hardest to pack: steps and turns without any pattern
    RunData run = make_run({.floes = 200, .frames = 400, .samples_per_frame = 50});
    std::mt19937 random(7);
    std::normal_distribution<double> step(0.0, 0.02);
    const auto steps = [&] { return Vec3(step(random), step(random), step(random)); };
    for (std::size_t k = 0; k < 200; ++k)
        run.frames[0].position[k] =
            Vec3(0.6 * static_cast<double>(k % 20), 0.9 * static_cast<double>(k / 20) - 4.0, -0.1);
    for (std::size_t f = 1; f < 400; ++f)
        for (std::size_t k = 0; k < 200; ++k) {
            run.frames[f].position[k] = run.frames[f - 1].position[k] + steps();
            const Vec3 turn = steps();
            run.frames[f].orientation[k] = Eigen::AngleAxisd(turn.norm(), turn.normalized()) *
                                           run.frames[f - 1].orientation[k];
            run.frames[f].contact_force[k] = 1e4 * steps();
        }
    read::RunFolder folder = make_folder();
    folder.data = std::move(run);
    CHECK(make_report(folder).size() < kTwoMegabytes);
}

TEST_CASE("1500 floes and 90000 samples give a report below 2 MB", "[report]") {
    RunData run = make_run({.floes = 1500, .frames = 45, .samples_per_frame = 2000});
    // a field of 1500 floes around the ship, not in two rows
    for (RunFrame& frame : run.frames)
        for (std::size_t k = 0; k < 1500; ++k) {
            frame.position[k] = Vec3(0.3 * static_cast<double>(k % 50) - 2.0,
                                     0.25 * static_cast<double>(k / 50) - 3.7, -0.1);
            frame.orientation[k] = Eigen::AngleAxisd(0.3 * static_cast<double>(k), Vec3::UnitX());
        }
    read::RunFolder folder = make_folder();
    folder.data = std::move(run);
    const std::string html = make_report(folder);
    CHECK(html.size() < kTwoMegabytes);
    CHECK(tag_fault(markup_of(html)).empty());
    CHECK_THAT(html, Catch::Contains("more views would make this page too large"));
    CHECK_THAT(html, Catch::Contains("From below, t = "));
}

TEST_CASE("a killed run is reported without statistics, one without samples too", "[report]") {
    read::RunFolder folder = make_folder();
    folder.summary.reset();
    const std::string html = make_report(folder);
    CHECK_THAT(html, Catch::Contains(">interrupted<"));
    CHECK_THAT(html, Catch::Contains("before it wrote summary.json"));
    CHECK(tag_fault(markup_of(html)).empty());
    folder.data.frames.clear();
    folder.data.history.clear();
    folder.data.tracks.clear();
    CHECK_THAT(make_report(folder), Catch::Contains("recorded no history"));
}

TEST_CASE("NaN in the summary shows as n/a", "[report]") {
    read::RunFolder folder = make_folder();
    folder.summary->resistance.ci95 = std::nan("");
    const std::string html = make_report(folder);
    CHECK_THAT(html, Catch::Contains("1107 \u00b1 n/a"));
}

TEST_CASE("a run folder of an older version has its report, without what it did not record",
          "[report]") {
    read::RunFolder folder = make_folder();
    folder.data.regions.clear();
    folder.data.panels = {};
    folder.data.header.average_from = std::nan("");
    Summary& s = *folder.summary;
    s.panels = {};
    s.ship = {};
    s.ice = {};
    s.travel = {};
    s.formulas.clear();
    s.regions["bottom"].force_peaks.reset();
    s.regions["bottom"].line_load_peaks.reset();
    const std::string html = make_report(folder);
    CHECK(tag_fault(markup_of(html)).empty());
    CHECK_THAT(html, Catch::Contains("1107 \u00b1 12 N") &&
                         Catch::Contains("Lindqvist (1989), submersion part") &&
                         Catch::Contains("1.00 m/s = 1.94 kn") &&
                         Catch::Contains("Moments of the ice on the ship"));
    for (const char* text : {"by region", "id=\"local\"", "Thickness", "nan"}) {
        CAPTURE(text);
        CHECK(markup_of(html).find(text) == std::string::npos);
    }
    s.lindqvist_submersion.reset();
    CHECK(make_report(folder).find("Lindqvist") == std::string::npos);
}

TEST_CASE("forces have one unit on the page, with the digits that the interval is worth",
          "[report]") {
    read::RunFolder folder = make_folder();
    CHECK(page_unit(folder).name == "N");
    CHECK(page_unit(folder).decimals == 0);
    folder.summary->resistance.mean = 440123.0;
    folder.summary->resistance.ci95 = 4720.0;
    CHECK(page_unit(folder).name == "kN");
    CHECK(page_unit(folder).decimals == 1);
    CHECK(moment_unit(page_unit(folder)).name == "kN m");
    const std::string html = markup_of(make_report(folder));
    CHECK_THAT(html, Catch::Contains("440.1 \u00b1 4.7 kN"));
    CHECK_THAT(html, Catch::Contains("[kN]"));
    CHECK(html.find("[N]") == std::string::npos);
    folder.summary.reset();  // the mean over the second half of the samples is 1100 N
    CHECK(page_unit(folder).name == "N");
    CHECK(moment_unit(choose_unit(12345.0, 2)).name == "kN m/m");
}

TEST_CASE("the contents link to every section behind them", "[report]") {
    const std::string html = markup_of(make_report(make_folder()));
    const std::size_t begin = html.find("<nav class=\"contents\">");
    REQUIRE(begin != std::string::npos);
    const std::string nav = html.substr(begin, html.find("</nav>", begin) - begin);
    for (const char* id : {"particulars", "forces", "histories", "regions", "local", "load",
                           "moments", "drawings", "tracked", "energy", "numerics", "origin"}) {
        CAPTURE(id);
        CHECK(count(nav, std::string("href=\"#") + id + "\"") == 1);
        CHECK(count(html, std::string("<section id=\"") + id + "\"") == 1);
    }
}

TEST_CASE("forces of 5 N, 12 kN and 30 MN get units and 4 digits, 2D is per metre", "[report]") {
    CHECK(choose_unit(5.0, 3).name == "N");
    CHECK(choose_unit(5.0, 3).text(5.0) == "5.000");
    CHECK(choose_unit(1107.0, 3).text(1107.4) == "1107");
    CHECK(choose_unit(-12345.0, 2).name == "kN/m");
    CHECK(choose_unit(-12345.0, 2).text(-12345.0) == "-12.35");
    CHECK(choose_unit(3e7, 3).text(3e7) == "30.00");
    CHECK(choose_unit(std::nan(""), 3).name == "N");
}

TEST_CASE("a view of one instant is a picture with a legend, without frames an error", "[report]") {
    const RunData run = make_run();
    const std::string svg = draw_view(run, views::ViewFrom::below, 2.04);
    CHECK_THAT(svg, Catch::Contains("t = 2.00 s"));
    CHECK_THAT(svg, Catch::Contains("touched by the ship"));
    CHECK(tag_fault(svg).empty());
    RunData none = run;
    none.frames.clear();
    CHECK_THAT(error_text([&] { draw_view(none, views::ViewFrom::below, 0.0); }),
               Catch::Contains("no frames"));
}

TEST_CASE("a page without room still has the last instant from below and above", "[report]") {
    const RunData run = make_run();
    const std::string section = scene_section(run, 0);
    CHECK_THAT(section, Catch::Contains("From below, t = 4.40 s") &&
                            Catch::Contains("From above, t = 4.40 s") &&
                            Catch::Contains("14 more views would make this page too large"));
    CHECK(count(section, "<h3>") == 1);
    // hulls of these two views alone
    CHECK(count(section, "<defs>") == 2);
    CHECK_THAT(scene_section(make_run({.dimension = 2}), 0),
               Catch::Contains("From starboard, t = 4.40 s"));
}
