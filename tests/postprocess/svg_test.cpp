// SPDX-License-Identifier: GPL-3.0-or-later
// Tolerances: 0.051 is half of a pixel's last digit, a tenth.
#include "postprocess/views/svg.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/tolerance.hpp"

using namespace ice::views;
using ice::test::Near;

TEST_CASE("text is made safe: <, >, &, quotes, control characters, broken UTF-8", "[views]") {
    CHECK(escape("a < b & \"c\" > d") == "a &lt; b &amp; &quot;c&quot; &gt; d");
    CHECK(escape("Møller m² €") == "Møller m² €");
    CHECK(escape(std::string("a\x01z\xff")) == "a?z?");
    CHECK(escape("\xc3") == "?");
}

TEST_CASE("pixels have at most one decimal and no zero before it", "[views]") {
    CHECK(pixels(12.34) == "12.3");
    CHECK(pixels(12.0) == "12");
    CHECK(pixels(-0.26) == "-.3");
    CHECK(pixels(-0.04) == "0");
    CHECK(pixels(NAN) == "0");
}

TEST_CASE("a path is written in steps that do not drift over 1000 points", "[views]") {
    CHECK(path_data({{0, 0}, {10, 0}, {10, -5.5}}, true) == "M0 0l10 0 0-5.5z");
    CHECK(path_data({{1, 1}}, true).empty());
    CHECK(path_data({}, false).empty());
    std::vector<Vec2> points;
    for (int k = 0; k <= 1000; ++k) points.emplace_back(0.33 * k, 0.0);
    const std::string data = path_data(points, false);
    // sum of the steps in x: every second number after the "l"
    double x = 0.0;
    std::size_t at = data.find('l') + 1;
    for (bool horizontal = true; at < data.size(); horizontal = !horizontal) {
        std::size_t used = 0;
        const double step = std::stod(data.substr(at), &used);
        if (horizontal) x += step;
        at += used;
    }
    CHECK(x == Near(330.0).margin(0.051));
}

TEST_CASE("numbers for people have 4 digits: 1234.5 N, 0.01235, 1.5", "[views]") {
    CHECK(readable(1234.56) == "1235");
    CHECK(readable(0.0123456) == "0.01235");
    CHECK(readable(1.5) == "1.5");
    CHECK(readable(0.0) == "0");
    CHECK(readable(1e9) == "1.000e+09");
    CHECK(readable(NAN) == "n/a");
}

TEST_CASE("brightness scales a colour and stops at white", "[views]") {
    CHECK(shade({100, 200, 0}, 0.5) == "#326400");
    CHECK(shade({200, 250, 0}, 1.3) == "#ffff00");
}
