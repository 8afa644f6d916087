// SPDX-License-Identifier: GPL-3.0-or-later
#include "postprocess/views/chart.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "postprocess/views/axis.hpp"
#include "postprocess/views/decimate.hpp"
#include "tests/postprocess/make_folder.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice::views;
using ice::test::count;
using ice::test::Near;
using ice::test::tag_fault;

TEST_CASE("20000 samples become at most 2000 points that keep a hit of one sample", "[views]") {
    std::vector<double> x, y;
    for (int k = 0; k < 20000; ++k) {
        x.push_back(0.005 * k);
        y.push_back(std::sin(0.01 * k));
    }
    y[12345] = 50.0;
    y[12346] = -60.0;
    const auto kept = decimate(x, y, 1000);
    CHECK(kept.size() <= 2000);
    CHECK(kept.size() > 1500);
    double high = 0.0, low = 0.0;
    for (std::size_t k = 0; k < kept.size(); ++k) {
        high = std::max(high, kept[k].y());
        low = std::min(low, kept[k].y());
        if (k > 0) REQUIRE(kept[k].x() > kept[k - 1].x());
    }
    CHECK(high == 50.0);
    CHECK(low == -60.0);
}

TEST_CASE("short curves stay whole, NaN is left out, all at one time does not divide by 0",
          "[views]") {
    CHECK(decimate({0, 1, 2}, {1, NAN, 3}, 10).size() == 2);
    CHECK(decimate({}, {}, 10).empty());
    CHECK(decimate(std::vector<double>(100, 1.0), std::vector<double>(100, 2.0), 10).size() == 1);
}

TEST_CASE("a logarithmic axis has whole decades, equally far apart", "[views][property]") {
    Chart chart;
    chart.x_logarithmic = true;
    chart.curves = {{"a", kBlue, {{20.0, 1.0}, {2000.0, 2.0}}, 1.0, "", 1.0}};
    const std::string svg = draw_chart(chart);
    std::vector<double> places;
    for (const char* label : {">10<", ">100<", ">1000<", ">10000<"}) {
        CAPTURE(label);
        const std::size_t at = svg.find(label);
        REQUIRE(at != std::string::npos);
        places.push_back(std::stod(svg.substr(svg.rfind("x=\"", at) + 3)));
    }
    // pixels are written to a tenth
    CHECK(places[1] - places[0] == Near(places[2] - places[1]).margin(0.21));
    CHECK(places[3] - places[2] == Near(places[2] - places[1]).margin(0.21));
}

TEST_CASE("ticks of 0 to 30 are 0, 10, 20, 30, labels have no needless decimals",
          "[views][analytic]") {
    CHECK(choose_ticks(0.0, 30.0, 4) == std::vector<double>{0, 10, 20, 30});
    CHECK(choose_ticks(-0.1, 0.1, 5).size() == 5);
    CHECK(choose_ticks(2.0, 2.0, 5) == std::vector<double>{2.0});
    CHECK(tick_label(0.5, 0.5) == "0.5");
    CHECK(tick_label(20.0, 10.0) == "20");
    CHECK(tick_label(-1e-17, 0.1) == "0.0");
}

TEST_CASE("a chart names its axes, curves and mean, and is well-formed", "[views]") {
    Chart chart;
    chart.title = "f < g";
    chart.y_title = "fx [N]";
    chart.curves = {{"contact", kBlue, {{0, 0}, {1, -5}, {2, 3}}, 1.0, ""},
                    {"friction", kOrange, {{0, 1}, {2, 1}}, 1.0, "6 3"}};
    chart.level = 1.5;
    chart.level_name = "mean";
    chart.averaged = {1.0, 2.0};
    const std::string svg = draw_chart(chart);
    for (const char* text : {"f &lt; g", "fx [N]", "time [s]", ">contact<", ">friction<", ">mean<"})
        CHECK_THAT(svg, Catch::Contains(text));
    CHECK(tag_fault(svg).empty());
    CHECK(count(svg, "<path") == 2);
}

TEST_CASE("a legend that is longer than the chart goes on in a second row", "[views]") {
    Chart chart;
    for (int k = 0; k < 6; ++k)
        chart.curves.push_back(
            {"a curve with a long name", kBlue, {{0, 0}, {1, 1}}, 1.0, "", 1.0, "os^vdx"[k]});
    const std::string svg = draw_chart(chart);
    CHECK(tag_fault(svg).empty());
    CHECK_THAT(svg, Catch::Contains("y=\"36\"") && Catch::Contains("y=\"54\""));
    // signs of two points and of the legend; circles are no paths
    CHECK(count(svg, "<circle") == 3);
    CHECK(count(svg, "<path") == 6 + 5 * 3);
}

TEST_CASE("a chart over the speed begins at 0 and has knots above", "[views]") {
    Chart chart;
    chart.x_title = "speed [m/s]";
    chart.x_from_zero = true;
    chart.top_scale = {1.0 / 0.514444, "speed [kn]"};
    chart.curves = {{"a", kBlue, {{1.0, 2.0}, {5.14444, 3.0}}, 1.0, ""}};
    const std::string svg = draw_chart(chart);
    CHECK_THAT(svg, Catch::Contains("speed [kn]") && Catch::Contains(">10</text>"));
    CHECK(tag_fault(svg).empty());
}

TEST_CASE("wide labels move the plot to the right", "[views]") {
    CHECK(label_width({0.0, 200000.0, 200.0, 0.0}) > label_width({0.0, 20.0, 200.0, 0.0}) + 20.0);
}

TEST_CASE("a chart without points says 'no data'", "[views]") {
    CHECK_THAT(draw_chart({}), Catch::Contains("no data"));
    Chart one;
    one.curves = {{"a", kBlue, {{1, 1}}, 1.0, ""}};
    CHECK(tag_fault(draw_chart(one)).empty());
}
