// SPDX-License-Identifier: GPL-3.0-or-later
// Grids, bricks, cusps and edges: where floes lie, what they cover, that none overlap.
//
// Tolerances: 1e-14 is rounding of places of 10 m; 1e-12 of an area that of a sum over floes.
#include <catch2/catch.hpp>
#include <cmath>

#include "preprocess/field/polygon_checks.hpp"
#include "tests/preprocess/field_support.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using namespace ice::test;

namespace {

const std::string kIce = "[ice]\nthickness = 0.3\n";
const std::string kGrid =
    "[area]\norigin = [5.0, 1.0]\n[floes]\nsize = [1.0, 0.8]\ncount = [4, 3]\ngap = [0.1, 0.2]\n";

std::string cusps(const std::string& more) {
    return "pattern = \"cusps\"\n" + kIce +
           "[area]\nsize = [80, 24]\n[floes]\nbreaking_length = 4\nbreaking_width = 8\n" + more;
}

// 1e-9: rounding of coordinates below 1e3 m, a hundred thousand times over
constexpr double kTouch = 1e-9;

}  // namespace

TEST_CASE("a grid lies where its case pattern would, x fastest", "[field][analytic]") {
    const FieldPlan plan = field_plan("pattern = \"grid\"\n" + kIce + kGrid);
    REQUIRE(plan.loose.size() == 12);
    CHECK(plan.fixed.empty());
    // breadth 3 x 0.8 + 2 x 0.2 = 2.8 m about y = 1
    CHECK((plan.loose[0][0] - Vec2(5.0, -0.4)).norm() < tolerance(1e-14));
    CHECK((plan.loose[1][0] - Vec2(6.1, -0.4)).norm() < tolerance(1e-14));
    CHECK((plan.loose[4][0] - Vec2(5.0, 0.6)).norm() < tolerance(1e-14));
    CHECK((plan.loose[11][2] - Vec2(9.3, 2.4)).norm() < tolerance(1e-14));
    CHECK((plan.area.sizes() - Vec2(4.3, 2.8)).norm() < tolerance(1e-14));
}

TEST_CASE("bricks are shifted by half a floe and the channel's sides stay straight",
          "[field][analytic]") {
    const FieldPlan plan = field_plan("pattern = \"brick\"\n" + kIce + kGrid);
    REQUIRE(plan.loose.size() == 3 + 4 + 3 + 4);
    for (std::size_t column = 0, k = 0; column < 4; ++column) {
        const std::size_t count = column % 2 == 0 ? 3 : 4;
        CHECK(plan.loose[k][0].y() == Near(-0.4));
        CHECK(plan.loose[k + count - 1][2].y() == Near(2.4));
        double length = 0.0;
        for (std::size_t j = 0; j < count; ++j)
            length += plan.loose[k + j][2].y() - plan.loose[k + j][0].y();
        CHECK(length == Near(2.8 - (static_cast<double>(count) - 1.0) * 0.2));
        // seams of odd columns are half a floe and gap beside those of even ones
        if (column == 1) CHECK(plan.loose[k + 1][0].y() - plan.loose[0][0].y() == Near(0.5));
        k += count;
    }
    CHECK_THROWS_WITH(field_plan("pattern = \"brick\"\n" + kIce +
                                 "[floes]\nsize = [1.0, 0.8]\ncount = [4, 3]\ngap = [0.1, 0.8]\n"),
                      Catch::Contains("floes.gap: leaves nothing of the half floes"));
}

TEST_CASE("edges lie beside the field, in equal pieces, with their overhang", "[field][analytic]") {
    const FieldPlan plan = field_plan("pattern = \"grid\"\n" + kIce + kGrid +
                                      "[edges]\nbreadth = 2\npiece = 3\ngap = 0.5\n"
                                      "overhang = [4, 1]\nahead = 0\n");
    // x from 1.0 to 10.3 m: four pieces of 2.325 m on each side
    REQUIRE(plan.fixed.size() == 8);
    CHECK((plan.fixed[0][0] - Vec2(1.0, -2.9)).norm() < tolerance(1e-14));
    CHECK((plan.fixed[3][2] - Vec2(10.3, -0.9)).norm() < tolerance(1e-14));
    CHECK((plan.fixed[4][0] - Vec2(1.0, 2.9)).norm() < tolerance(1e-14));
    for (const Outline& piece : plan.fixed) CHECK(area_of(piece) == Near(2.325 * 2.0));
}

TEST_CASE("unbroken ice closes a channel's far end from side to side, without overlap or leak",
          "[field][analytic]") {
    // the grid's area: x 5.0 to 9.3, y -0.4 to 2.4 m; sides from 1.0 to 10.8 m, the end from 9.8 m
    const FieldPlan plan = field_plan("pattern = \"grid\"\n" + kIce + kGrid +
                                      "[edges]\nbreadth = 2\npiece = 3\ngap = 0.5\n"
                                      "overhang = [4, 0]\nahead = 1\n");
    REQUIRE(plan.fixed.size() == 4 + 4 + 2);
    for (std::size_t side : {0u, 4u})
        CHECK(plan.fixed[side + 3][2].x() == Near(10.8).epsilon(1e-14));
    CHECK((plan.fixed[8][0] - Vec2(9.8, -0.9)).norm() < tolerance(1e-14));
    CHECK((plan.fixed[8][2] - plan.fixed[9][1]).norm() < tolerance(1e-14));
    CHECK((plan.fixed[9][2] - Vec2(10.8, 2.9)).norm() < tolerance(1e-14));
    // flush with both sides: floes find no way round, and nothing lies over anything
    CHECK(plan.fixed[8][0].y() == Near(plan.fixed[0][2].y()).epsilon(1e-14));
    CHECK(plan.fixed[9][2].y() == Near(plan.fixed[4][0].y()).epsilon(1e-14));
    std::vector<Outline> all = plan.loose;
    all.insert(all.end(), plan.fixed.begin(), plan.fixed.end());
    for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) CHECK(overlap_depth(all[i], all[j]) < kTouch);
}

TEST_CASE("a longer overhang stays as it is beside a closed end", "[field]") {
    const std::string edges = "[edges]\nbreadth = 2\noverhang = [0, 7]\n";
    const FieldPlan plan = field_plan("pattern = \"grid\"\n" + kIce + kGrid + edges);
    CHECK(plan.fixed[0][1].x() < 16.3);
    CHECK(plan.fixed[1][1].x() == Near(16.3));
    CHECK(plan.fixed.back()[0].x() == Near(9.3));
    CHECK(plan.fixed.back()[1].x() == Near(11.3));  // as long as the sides are broad
}

TEST_CASE("channels of every pattern are closed ahead unless the specification says 0", "[field]") {
    const std::string pattern =
        GENERATE_COPY("pattern = \"grid\"\n" + kIce + kGrid, "pattern = \"brick\"\n" + kIce + kGrid,
                      cusps(""), cusps("entrance_angle = \"35 deg\"\n"),
                      "pattern = \"voronoi\"\n" + kIce +
                          "[area]\nsize = [30, 10]\n[floes]\nconcentration = 0.8\nmean_size = 2\n");
    const std::string edges = "[edges]\nbreadth = 1.5\ngap = 0.25\n";
    const FieldPlan open = field_plan(pattern + edges + "ahead = 0\n");
    const FieldPlan closed = field_plan(pattern + edges);
    CHECK(open.loose == closed.loose);
    double far = 0.0;
    for (const Outline& floe : closed.loose)
        for (const Vec2& corner : floe) far = std::max(far, corner.x());
    const double end = std::max(far, closed.area.max().x()) + 0.25;
    // the last pieces lie across the end, from side to side
    double breadth = 0.0;
    for (const Outline& piece : closed.fixed) {
        if (piece[0].x() != Near(end)) continue;
        breadth += piece[2].y() - piece[0].y();
        CHECK(piece[1].x() == Near(end + 1.5));
    }
    CHECK(breadth == Near(closed.area.sizes().y() + 0.5));
    for (const Outline& piece : open.fixed) CHECK(piece[0].x() < end);
    for (const Outline& floe : closed.loose)
        for (const Outline& piece : closed.fixed) REQUIRE(overlap_depth(floe, piece) < kTouch);
    CHECK(field_plan(pattern + edges).fixed == closed.fixed);  // the same every time
}

TEST_CASE("a closed end without sides is refused, and without edges there is none",
          "[field][errors]") {
    const std::string grid = "pattern = \"grid\"\n" + kIce + kGrid;
    CHECK(field_plan(grid).fixed.empty());
    CHECK_THROWS_WITH(field_plan(grid + "[edges]\nahead = 2\n"),
                      Catch::Contains("edges.ahead closes a channel, but edges.breadth is 0"));
}

TEST_CASE("cusps fill the channel: each row is as long as the breaking length", "[field]") {
    for (const char* more : {"", "jitter = 0\n", "jitter = 0.9\n", "breaking_depth = 3.9\n",
                             "entrance_angle = \"35 deg\"\n", "breaking_depth = 0\n"}) {
        CAPTURE(more);
        const FieldPlan plan = field_plan(cusps(more));
        // twenty rows of three whole or two whole and two half cusps
        CHECK(plan.loose.size() == 10 * 3 + 10 * 4);
        for (const Outline& floe : plan.loose) {
            CHECK(is_simple(floe));
            CHECK(area_of(floe) > 0.0);
        }
        double deepest = 0.0;
        for_near_pairs(plan.loose, [&](const Outline& a, const Outline& b) {
            deepest = std::max(deepest, overlap_depth(a, b));
        });
        CHECK(deepest < kTouch);
    }
}

TEST_CASE("cusps without jitter have the exact area of their arcs", "[field][analytic]") {
    // rows 80 m long, and the last front's arcs in place of the first's, all 8 m wide and 2 m deep
    const FieldPlan plan = field_plan(cusps("jitter = 0\n"));
    CHECK(total_area(plan.loose) == Near(80.0 * 24.0).epsilon(1e-12));
    // equal shapes: whole cusps behind halves, halves at each side, whole ones behind whole ones
    FieldReport report;
    const FieldSpec spec = field_spec(cusps("jitter = 0\n"));
    CHECK(make_field(spec, plan, report).shapes.size() <= 10);
}

TEST_CASE("a gap between cusps is open water everywhere", "[field]") {
    const FieldPlan plan = field_plan(cusps("gap = [0.2, 0.1]\n"));
    double nearest = 1e9;
    for_near_pairs(plan.loose, [&](const Outline& a, const Outline& b) {
        for (const Outline* one : {&a, &b})
            for (const Vec2& p : *one) {
                const Outline& other = one == &a ? b : a;
                for (std::size_t k = 0; k < other.size(); ++k) {
                    const Vec2 q = other[k], edge = other[(k + 1) % other.size()] - q;
                    const double t = std::clamp((p - q).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
                    nearest = std::min(nearest, (p - q - t * edge).norm());
                }
            }
    });
    // along x the gap is 0.2 m; arcs 2 m deep over 8 m are at most 53 degrees steep
    CHECK(nearest > 0.2 * std::cos(53.2 / 180.0 * 3.14159));
    CHECK(nearest < 0.2);
    CHECK_THROWS_WITH(field_plan(cusps("gap = [5, 0]\n")),
                      Catch::Contains("floes.gap: leaves nothing of a cusp"));
}

TEST_CASE("another seed, other cusps, the same seed, the same", "[field]") {
    const auto corners = [](const std::string& seed) {
        return field_plan("seed = " + seed + "\n" + cusps("")).loose;
    };
    CHECK(corners("4") == corners("4"));
    CHECK(corners("4") != corners("5"));
}
