// SPDX-License-Identifier: GPL-3.0-or-later
// Fields from a file of polygons.
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "common/base/error.hpp"
#include "preprocess/field/plan_floes.hpp"
#include "tests/preprocess/field_support.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using namespace ice::test;

namespace {

std::string polygons(const std::string& suffix, const std::string& text, std::size_t count,
                     std::vector<std::string>* warnings = nullptr) {
    const TemporaryFile file(suffix, text);
    try {
        std::vector<std::string> unused;
        const FieldSpec spec = field_spec(
            "pattern = \"polygons\"\n[ice]\nthickness = 0.5\n[floes]\nscale = 2\nfile = "
            "\"" +
            file.path().string() + "\"\n[area]\norigin = [10, 0]\n");
        const FieldPlan plan = plan_field(spec, warnings ? *warnings : unused);
        CHECK(plan.loose.size() == count);
        for (const Outline& floe : plan.loose) CHECK(area_of(floe) > 0.0);
        CHECK(plan.area.min().x() == 10.0);
        CHECK(total_area(plan.loose) == Near(4.0 * static_cast<double>(count)));
    } catch (const Error& error) {
        CHECK(error.code() == ExitCode::bad_input);
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("polygons come from CSV and GeoJSON, scaled, moved and turned", "[field]") {
    // unit squares: one clockwise, one with a point on an edge, touching along an edge
    CHECK(polygons(".csv",
                   "floe,x,y\n7,0,0\n7,0,1\n7,1,1\n7,1,0\n# next\n8,1,0\n8,1.5,0\n8,2,0\n"
                   "8,2,1\n8,1,1\n",
                   2) == "");
    std::vector<std::string> warnings;
    CHECK(polygons(".geojson",
                   R"({"type":"FeatureCollection","features":[
                   {"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":
                     [[[0,0],[1,0],[1,1],[0,1],[0,0]],
                      [[0.4,0.4],[0.4,0.6],[0.6,0.6],[0.4,0.4]]]}},
                   {"type":"Feature","geometry":{"type":"MultiPolygon","coordinates":
                     [[[[1,0],[2,0],[2,1],[1,1],[1,0]]],[[[3,0],[4,0],[4,1],[3,1]]]]}},
                   {"type":"Feature","geometry":{"type":"Point","coordinates":[9,9]}},
                   {"type":"Feature","geometry":null}]})",
                   3, &warnings) == "");
    REQUIRE(warnings.size() == 1);
    CHECK_THAT(warnings[0], Catch::Contains("1 holes in polygons are filled"));
}

TEST_CASE("polygons that are none, or overlap, are named", "[field][errors]") {
    CHECK_THAT(polygons(".csv", "a,0,0\na,1,1\na,1,0\na,0,1\n", 1),
               Catch::Contains("floe a: crosses itself"));
    CHECK_THAT(polygons(".csv", "a,0,0\na,1,1\n", 1),
               Catch::Contains("floe a: has fewer than three corners"));
    CHECK_THAT(polygons(".csv", "a,0,0\na,1,x\n", 1), Catch::Contains(".csv:2: is no row"));
    CHECK_THAT(polygons(".csv", "a,0,0\na,1,inf\na,1,1\n", 1), Catch::Contains("infinity"));
    CHECK_THAT(polygons(".csv", "", 1), Catch::Contains("holds no polygons"));
    CHECK_THAT(polygons(".csv", "a,0,0\na,1,0\na,1,1\nb,0.5,0\nb,2,0\nb,2,1\n", 2),
               Catch::Contains("floe a: overlaps floe b by 0.") && Catch::Contains(" m"));
    CHECK_THAT(polygons(".json", "{", 1), Catch::Contains("is no GeoJSON"));
    CHECK_THAT(polygons(".json", R"({"type":"Polygon","coordinates":[[[0,"a"]]]})", 1),
               Catch::Contains("is no GeoJSON"));
    CHECK_THAT(polygons(".json", R"({"type":"Point","coordinates":[0,1]})", 1),
               Catch::Contains("holds no polygons"));
}
