// SPDX-License-Identifier: GPL-3.0-or-later
// Peaks and panels in summary.json.
#include "common/formats/load_statistics.hpp"

#include <catch2/catch.hpp>

#include "common/formats/summary_file.hpp"
#include "tests/common/fixtures.hpp"

using namespace ice;
using namespace ice::test;

namespace {

Summary make_summary() {
    Summary s;
    RegionStatistics& bow = s.regions["bow"];
    bow.force_peaks = {2, 900.0, 2100.0, 2500.0, {{2500.0, 180.0}, {2200.0, 360.0}}};
    bow.line_load_peaks = {1, 90.0, 210.0, 250.0, {{250.0, 180.0}}};
    s.panels = {0.3, 0.1, 400, 12, {}};
    s.panels.hardest.push_back(
        {"bow", {0, {9.0, 0.5, -0.25}, {0.5, 0.0, -0.5}, 0.125, 0.25, 64.0, 128.0, 256.0}});
    return s;
}

}  // namespace

TEST_CASE("peaks and panels of a summary come back", "[formats]") {
    const TempFolder folder;
    write_bytes(folder / "summary.json", summary_text(make_summary()));
    const Summary back = read_summary(folder / "summary.json");
    REQUIRE(back.regions.at("bow").force_peaks);
    CHECK(back.regions.at("bow").force_peaks->count == 2);
    CHECK(back.regions.at("bow").force_peaks->exceeded[1].level == 2200.0);
    CHECK(back.regions.at("bow").force_peaks->exceeded[1].per_hour == 360.0);
    CHECK(back.regions.at("bow").line_load_peaks->p99 == 210.0);
    CHECK(back.panels.size == 0.3);
    CHECK(back.panels.window == 0.1);
    CHECK(back.panels.count == 400);
    REQUIRE(back.panels.hardest.size() == 1);
    CHECK(back.panels.hardest[0].first == "bow");
    CHECK(back.panels.hardest[0].second.center == Vec3(9.0, 0.5, -0.25));
    CHECK(back.panels.hardest[0].second.max == 256.0);
    CHECK(summary_text(back) == summary_text(make_summary()));
}

TEST_CASE("panels and peaks have the names of the schema, per metre in 2D", "[formats]") {
    const TempFolder folder;
    Summary s = make_summary();
    write_bytes(folder / "summary.json", summary_text(s));
    auto numbers = read_json_numbers(folder / "summary.json");
    CHECK(numbers.at("panels.0.line_load_max_N_per_m") == 1024.0);  // 256 N on 0.25 m
    CHECK(numbers.at("panels.0.pressure_p99_Pa") == 1024.0);        // 128 N on 0.125 m2
    CHECK(numbers.at("panels.0.area_m2") == 0.125);
    CHECK(numbers.at("panel_rule.size_m") == 0.3);
    CHECK(numbers.at("regions.bow.force_peaks.max_N") == 2500.0);
    CHECK(numbers.at("regions.bow.force_peaks.exceeded.0.level_N") == 2500.0);
    CHECK(numbers.at("regions.bow.line_load_peaks.max_N_per_m") == 250.0);
    s.dimension = 2;
    write_bytes(folder / "summary.json", summary_text(s));
    numbers = read_json_numbers(folder / "summary.json");
    CHECK(numbers.at("regions.bow.force_peaks.max_N_per_m") == 2500.0);
    CHECK(numbers.at("regions.bow.line_load_peaks.max_N_per_m") == 250.0);
}

TEST_CASE("a summary without panels is one without them, a wrong one names the key", "[formats]") {
    const TempFolder folder;
    Summary s = make_summary();
    s.panels = {};
    s.regions["bow"].force_peaks.reset();
    s.regions["bow"].line_load_peaks.reset();
    write_bytes(folder / "summary.json", summary_text(s));
    CHECK(read_summary(folder / "summary.json").panels.hardest.empty());
    std::string text = summary_text(make_summary());
    const std::string key = "\"length_m\": 0.25";
    text.replace(text.find(key), key.size(), "\"length_m\": \"short\"");
    write_bytes(folder / "summary.json", text);
    CHECK_THAT(error_text([&] { read_summary(folder / "summary.json"); }),
               Catch::Contains("summary.json: panels: has a missing key or the wrong type"));
}
