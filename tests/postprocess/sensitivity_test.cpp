// SPDX-License-Identifier: GPL-3.0-or-later
// Tolerances: 1e-5 is the last digit of t in a table.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <regex>

#include "postprocess/sensitivity/rank_inputs.hpp"
#include "postprocess/sensitivity/tornado.hpp"
#include "postprocess/sensitivity/write_study.hpp"
#include "tests/postprocess/make_folder.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using namespace ice::test;
using namespace ice::sensitivity;

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Seeds ensemble(const std::string& label, const std::vector<double>& values, double half = kNaN) {
    return {label, values, std::vector<double>(values.size(), half)};
}

void write_run(const TempFolder& folder, const std::string& name, double resistance) {
    std::filesystem::create_directories(folder / ("runs/" + name));
    Summary s = *make_folder().summary;
    s.resistance.mean = resistance;
    s.resistance.ci95 = 5.0;
    write_bytes(folder / ("runs/" + name + "/summary.json"), summary_text(s));
}

// The case at 1000 N; drag 2 gives 1100 N, drag 0.5 gives 800 N, the step nothing; one run failed.
void write_study(const TempFolder& folder) {
    std::string plan = "title = \"a <study>\"\naxes = []\n";
    const auto add = [&](const std::string& input, const std::string& label, double resistance) {
        for (const int seed : {1, 2, 3}) {
            const std::string name = fmt::format("{}{}__seed={}", input, label, seed);
            plan += fmt::format("[[run]]\nname = \"{}\"\ninput = \"{}\"\nlabel = \"{}\"\n", name,
                                input, label);
            if (std::isfinite(resistance)) write_run(folder, name, resistance + seed - 2.0);
        }
    };
    add("", "", 1000.0);
    add("step", "0.02", 1000.0);
    add("drag", "0.5", 800.0);
    add("drag", "2", 1100.0);
    add("rule", "never", kNaN);
    for (const char* input : {"rule", "step", "drag"})
        plan +=
            fmt::format("[[input]]\nname = \"{0}\"\nbase = \"1\"\nsource = \"of {0}\"\n", input);
    plan += "[[left_out]]\nname = \"saw cut\"\nwhy = \"there is none\"\n";
    write_bytes(folder / "runs.toml", plan);
}

}  // namespace

TEST_CASE("Welch's interval is the two-sample one for equal scatter, Student's for one-sided",
          "[sensitivity][analytic]") {
    const Seeds a = ensemble("", {9.0, 10.0, 11.0}), b = ensemble("", {19.0, 20.0, 21.0});
    // both have s = 1: v = 4, t_{0.975, 4} = 2.77645 (tables)
    CHECK(estimate_difference(a, b).mean == Near(10.0));
    CHECK(estimate_difference(a, b).half == Near(2.77645 * std::sqrt(2.0 / 3.0)).epsilon(1e-5));
    CHECK(estimate_difference(b, a).mean == Near(-10.0));
    // no scatter in one: what is left is Student's interval of the other, v = 2, t = 4.30265
    const Seeds still = ensemble("", {5.0, 5.0, 5.0, 5.0});
    CHECK(estimate_difference(a, still).half == Near(4.30265 / std::sqrt(3.0)).epsilon(1e-5));
    CHECK(estimate_difference(still, still).half == 0.0);
    // single runs have their own intervals, which add as squares
    CHECK(estimate_difference(ensemble("", {1.0}, 3.0), ensemble("", {2.0}, 4.0)).half == 5.0);
    CHECK(std::isnan(estimate_difference(a, ensemble("", {2.0})).half));
    CHECK(std::isnan(estimate_difference(a, ensemble("", {})).mean));
}

TEST_CASE("a study's inputs are ranked by what they move, and a change must beat its interval",
          "[sensitivity]") {
    const TempFolder folder;
    write_study(folder);
    const Study study = read_study(folder.path());
    CHECK(study.base.resistance == std::vector<double>{999.0, 1000.0, 1001.0});
    CHECK(study.base.half == std::vector<double>{5.0, 5.0, 5.0});
    REQUIRE(study.left_out.size() == 1);

    const auto ranked = rank_inputs(study);
    REQUIRE(ranked.size() == 3);
    CHECK(ranked[0].name == "drag");
    CHECK(ranked[0].largest() == Near(200.0));
    REQUIRE(ranked[0].changes.size() == 2);
    CHECK(ranked[0].changes[0].difference.mean == Near(-200.0));
    CHECK(ranked[0].changes[1].difference.mean == Near(100.0));
    CHECK(ranked[0].changes[1].significant());
    // no change and no result: in the plan's order behind what moves, and neither is significant
    CHECK(ranked[1].name == "rule");
    CHECK(ranked[2].name == "step");
    CHECK_FALSE(ranked[1].changes[0].significant());
    CHECK_FALSE(ranked[2].changes[0].significant());
}

TEST_CASE("a study's text and page give the interval beside the model uncertainty",
          "[sensitivity]") {
    const TempFolder folder;
    write_study(folder);
    const Study study = read_study(folder.path());
    const std::string text = study_text(study);
    // Student's interval of 999, 1000, 1001, and a tenth of 1000
    CHECK_THAT(text, Catch::Contains("1000 \u00b1 2 N (95 %, 3 seeds)"));
    CHECK_THAT(text, Catch::Contains("\u00b1 10 % stated model uncertainty") &&
                         Catch::Contains(": \u00b1 100 N"));
    CHECK_THAT(text, Catch::Contains("-20.0 %  *") && Catch::Contains("+10.0 %  *"));
    CHECK_THAT(text, Catch::Contains("left out: saw cut, because there is none"));
    CHECK(text.find("drag") < text.find("step"));

    const std::string page = make_study_page(study);
    CHECK_THAT(page, Catch::Contains("a &lt;study&gt;") && Catch::Contains("of drag"));
    CHECK_THAT(page, Catch::Contains("3 of 15 runs have no result"));
    CHECK_THAT(page, Catch::Contains("there is none"));
    CHECK(page.find("nan") == std::string::npos);
    CHECK(tag_fault(markup_of(page)) == "");
}

TEST_CASE("a study in level ice gives the errors against model tests in place of 10 %",
          "[sensitivity]") {
    const TempFolder folder;
    write_study(folder);
    // the case itself decides; the runs of an input may have another release rule
    for (const int seed : {1, 2, 3}) {
        const auto file = folder / fmt::format("runs/__seed={}/summary.json", seed);
        Summary s = read_summary(file);
        s.ice.hold = {"until-bent", "always"};
        write_bytes(file, summary_text(s));
    }
    const Study study = read_study(folder.path());
    CHECK(study.level_ice);
    const std::string text = study_text(study);
    // of a mean of 1000 N
    CHECK_THAT(text, Catch::Contains("6 to 45 % mean error against model tests in level ice, on "
                                     "top of it: 60 to 450 N"));
    const std::string page = make_study_page(study), svg = make_tornado(study);
    CHECK_THAT(page, Catch::Contains("<b>60 to 450 N</b>") &&
                         Catch::Contains("the least and the largest mean error against model "
                                         "tests (docs/validation-measured.md), and the bars."));
    CHECK_THAT(svg, Catch::Contains("error in model tests, 6 to 45 %"));
    for (const std::string& out : {text, page, svg})
        CHECK_THAT(out, !Catch::Contains("10 % stated") && !Catch::Contains("model uncertainty"));
    CHECK(tag_fault(markup_of(page)) == "");
    // one band inside the other: 6 and 45 % to both sides
    const auto breadth = [&](const std::string& color) {
        std::smatch found;
        const std::regex band(
            "<rect x=\"[0-9.]+\" y=\"[0-9.]+\" width=\"([0-9.]+)\" "
            "height=\"[0-9.]+\" fill=\"" +
            color + "\"/>");
        return std::regex_search(svg, found, band) ? std::stod(found[1]) : 0.0;
    };
    REQUIRE(breadth("#e4e7ea") > 0.0);
    CHECK(breadth("#f1f3f5") == Near(breadth("#e4e7ea") * 45.0 / 6.0).margin(0.5));
}

TEST_CASE("bars of the tornado are as long as the differences and stay inside the chart",
          "[sensitivity][property]") {
    const TempFolder folder;
    write_study(folder);
    const std::string svg = make_tornado(read_study(folder.path()));
    CHECK(svg.find("nan") == std::string::npos);
    CHECK(tag_fault(svg) == "");
    CHECK_THAT(svg, Catch::Contains("never: no result"));
    const std::regex bar(
        R"re(<rect x="([-0-9.]+)" y="[-0-9.]+" width="([-0-9.]+)" height="14" )re");
    std::vector<double> widths;
    for (std::sregex_iterator it(svg.begin(), svg.end(), bar), end; it != end; ++it) {
        CHECK(std::stod((*it)[1]) >= 236.0);
        CHECK(std::stod((*it)[1]) + std::stod((*it)[2]) <= 846.0);
        widths.push_back(std::stod((*it)[2]));
    }
    REQUIRE(widths.size() == 3);                            // -20 %, +10 %, 0
    CHECK(widths[0] == Near(2.0 * widths[1]).margin(0.3));  // pixels are rounded to tenths
    CHECK(widths[2] < 0.2);
}

TEST_CASE("what is no sensitivity study is refused with the command that fits", "[sensitivity]") {
    const TempFolder folder;
    CHECK_THROWS_WITH(read_study(folder.path()), Catch::Contains("has no runs.toml"));
    CHECK_THROWS_WITH(read_study(folder / "none"), Catch::Contains("folder not found"));
    write_bytes(folder / "runs.toml", "[[run]]\nname = \"a\"\n");
    CHECK_THROWS_WITH(read_study(folder.path()), Catch::Contains("icepost sweep"));
    write_bytes(folder / "runs.toml",
                "[[run]]\nname = \"a\"\ninput = \"\"\n[[input]]\nname = \"drag\"\n");
    CHECK_THROWS_WITH(read_study(folder.path()), Catch::Contains("case itself"));
}
