// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <limits>

#include "postprocess/check/check_run.hpp"
#include "tests/postprocess/make_folder.hpp"

using namespace ice;
using namespace ice::test;
using namespace ice::check;

namespace {

const std::map<std::string, double> kNumbers{
    {"resistance.mean_N", 1107.0}, {"floes.moved", 5.0}, {"vertical.ci95_N", std::nan("")}};

std::vector<Verdict> check_text(const std::string& toml) {
    const TempFolder folder;
    write_bytes(folder / "expected.toml", toml);
    return check_numbers(kNumbers, read_expected(folder / "expected.toml"), "expected.toml");
}

bool passes(const std::string& bounds) {
    return all_passed(check_text("[[expect]]\nkey = \"resistance.mean_N\"\n" + bounds));
}

std::string complaint(const std::string& toml) {
    return error_text([&] { check_text(toml); });
}

}  // namespace

TEST_CASE("1107 N is 1100 within 10 or 1 %, not within 5 or 0.5 %", "[check][analytic]") {
    CHECK(passes("value = 1100\nabs = 10.0"));
    CHECK(passes("value = 1100.0\nrel = 0.01"));
    CHECK(passes("value = 1100.0\nrel = 0.001\nabs = 7.0"));  // the wider of both holds
    CHECK(passes("value = 1107\nabs = 0"));
    CHECK_FALSE(passes("value = 1100.0\nabs = 5.0"));
    CHECK_FALSE(passes("value = 1100.0\nrel = 0.005"));
}

TEST_CASE("1107 N lies in [1000, 1200] and [1107, inf), not below 1106", "[check][analytic]") {
    CHECK(passes("min = 1000\nmax = 1200"));
    CHECK(passes("min = 1107"));
    CHECK(passes("max = inf"));
    CHECK_FALSE(passes("max = 1106"));
    CHECK_FALSE(passes("min = 1108"));
}

TEST_CASE("a number that is null in the summary never passes", "[check]") {
    const auto verdicts = check_text("[[expect]]\nkey = \"vertical.ci95_N\"\nmin = -inf");
    CHECK_FALSE(verdicts[0].passed);
    CHECK_THAT(verdict_table(verdicts), Catch::Contains("null"));
}

TEST_CASE("the table and the JUnit file show the miss and its reason", "[check]") {
    const auto verdicts = check_text(
        "[[expect]]\nkey = \"resistance.mean_N\"\nmin = 1\nwhy = \"ice slows ships\"\n"
        "[[expect]]\nkey = \"floes.moved\"\nvalue = 7\nabs = 1\nwhy = \"a < b\"\n");
    const std::string text = verdict_table(verdicts);
    CHECK_THAT(text, Catch::Contains("ok    resistance.mean_N"));
    CHECK_THAT(text, Catch::Contains("MISS  floes.moved"));
    CHECK_THAT(text, Catch::Contains("7 +- 1"));
    CHECK_THAT(text, Catch::Contains("ice slows ships"));
    CHECK_THAT(text, Catch::Contains("1 of 2 as expected"));
    const std::string junit = junit_text(verdicts, "results/box");
    CHECK_THAT(junit, Catch::Contains("tests=\"2\" failures=\"1\""));
    CHECK_THAT(junit, Catch::Contains("<failure message=\"5 is not 7 +- 1\">a &lt; b</failure>"));
    CHECK(tag_fault(junit).empty());
}

TEST_CASE("a key the summary does not have is named with line, column and the nearest one",
          "[check]") {
    const std::string text = complaint("\n[[expect]]\nkey = \"resistance.mean\"\nmin = 0\n");
    CHECK_THAT(text, Catch::Contains("expected.toml:3:7: the run's summary has no number "
                                     "'resistance.mean'"));
    CHECK_THAT(text, Catch::Contains("did you mean 'resistance.mean_N'?"));
    CHECK_THAT(complaint("[[expect]]\nkey = \"zzz\"\nmin = 0\n"),
               Catch::Contains("see summary.json for the keys"));
}

TEST_CASE("faults of the file are named with line and column", "[check]") {
    const std::string key = "[[expect]]\nkey = \"floes.moved\"\n";
    CHECK_THAT(complaint("[[expect]\n"), Catch::Contains("expected.toml:1:"));
    CHECK_THAT(complaint(""), Catch::Contains("holds no [[expect]] entries"));
    CHECK_THAT(complaint("[[expects]]\nmin = 0\n"), Catch::Contains("did you mean 'expect'?"));
    CHECK_THAT(complaint(key + "valeu = 3\nabs = 1\n"),
               Catch::Contains("expected.toml:3:1: unknown key 'valeu'") &&
                   Catch::Contains("did you mean 'value'?"));
    CHECK_THAT(complaint(key + "min = \"3\"\n"), Catch::Contains(":3:7: min is not a number"));
    CHECK_THAT(complaint(key + "value = 3\nabs = -1\n"), Catch::Contains(":4:7: abs is negative"));
    CHECK_THAT(complaint(key + "value = 3\n"), Catch::Contains("has no clear bound"));
    CHECK_THAT(complaint(key + "min = 3\nabs = 1\n"), Catch::Contains("has no clear bound"));
    CHECK_THAT(complaint(key), Catch::Contains("has no clear bound"));
    CHECK_THAT(complaint(key + "min = 3\nmax = 2\n"), Catch::Contains("has min above max"));
    CHECK_THAT(complaint("[[expect]]\nmin = 0\n"), Catch::Contains("an expectation without key"));
    CHECK_THAT(error_text([] { read_expected("no.toml"); }), Catch::Contains("file not found"));
}

TEST_CASE("every case says what is expected of it and where each value comes from", "[check]") {
    int cases = 0;
    for (const auto& entry : std::filesystem::directory_iterator(ICE_SOURCE_DIR "/cases")) {
        if (!std::filesystem::exists(entry.path() / "case.cfg")) continue;
        ++cases;
        CAPTURE(entry.path().string());
        for (const Expectation& e : read_expected(entry.path() / "expected.toml")) {
            CAPTURE(e.key);
            CHECK(e.why.size() > 10);
        }
    }
    CHECK(cases > 0);
}
