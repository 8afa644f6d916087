// SPDX-License-Identifier: GPL-3.0-or-later
// Outline and loads of a hull on a page, whose lengths and places are known.
#include "postprocess/views/hull_drawing.hpp"

#include <catch2/catch.hpp>
#include <regex>

#include "postprocess/statistics/load_map.hpp"
#include "postprocess/views/load_view.hpp"
#include "tests/common/fixtures.hpp"

using namespace ice;
using namespace ice::test;
using namespace ice::views;

namespace {

// All matches of a pattern's groups as numbers.
std::vector<std::vector<double>> numbers_of(const std::string& text, const std::string& pattern) {
    const std::regex form(pattern);
    std::vector<std::vector<double>> out;
    for (std::sregex_iterator k(text.begin(), text.end(), form), end; k != end; ++k) {
        out.emplace_back();
        for (std::size_t group = 1; group < k->size(); ++group)
            out.back().push_back(std::stod((*k)[group]));
    }
    return out;
}

}  // namespace

TEST_CASE("the outline of a hull with a sponson leaves out what lies inside it", "[views]") {
    TriangleMesh hull = make_box({8.0, 2.0, 1.2});
    // 1 m broad, from the centre line to 1 m beyond the side
    const TriangleMesh sponson = make_box({1.0, 2.0, 0.4}, {0.0, 1.0, 0.0});
    for (const auto& t : sponson.triangles) {
        hull.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
        hull.region.push_back(0);
    }
    hull.vertices.insert(hull.vertices.end(), sponson.vertices.begin(), sponson.vertices.end());
    // the water far above: no line of it
    const std::string lines =
        draw_hull_lines(hull, projection_of(ViewFrom::top), {-5.0, 5.0, 0.0, 0.0, 50.0}, 10.0);
    double length = 0.0;
    for (const auto& step : numbers_of(lines, "l(-?[0-9.]+) ?(-?[0-9.]+)"))
        length += std::hypot(step[0], step[1]);
    // the hull's 20 m, with three sides of a square in the place of the fourth, at 50 px/m; a
    // piece of 4 px more or less at each of four corners, and as much where the sides meet
    CHECK(length == Approx(50.0 * 22.0).margin(32.0));
}

TEST_CASE("loads are drawn where they are, on the hull's foremost quarter", "[views]") {
    const TriangleMesh hull = make_box({8.0, 2.0, 1.2});
    const TriangleMesh fine = statistics::refine_mesh(hull, 0.25, 100000);
    std::vector<double> load(fine.triangles.size(), 0.0);
    for (std::size_t t = 0; t < load.size(); ++t) {
        const double x = (fine.corner(t, 0) + fine.corner(t, 1) + fine.corner(t, 2)).x() / 3.0;
        if (x > 2.0) load[t] = 1e5;
    }
    const std::string svg = draw_load_view({hull, fine, load, 1e5, 0.0}, ViewFrom::below, 600.0);
    const auto cells = numbers_of(svg, "M([0-9.]+) ([0-9.]+)h([0-9.]+)v([0-9.]+)h-");
    REQUIRE(cells.size() > 10);
    double left = 1e9, right = 0.0, top = 1e9, low = 0.0;
    for (const auto& cell : cells) {
        left = std::min(left, cell[0]);
        right = std::max(right, cell[0] + cell[2]);
        top = std::min(top, cell[1]);
        low = std::max(low, cell[1] + cell[3]);
    }
    // 2 m along and 2 m across, each to a cell of 3 px at both ends, and triangles' corners
    CHECK(right - left == Approx(low - top).margin(12.0));
    CHECK(left > 400.0);
    CHECK_THAT(draw_load_legend("50", "100", "kPa", "mean pressure"),
               Catch::Contains(">mean pressure [kPa], linear scale<"));
}
