// SPDX-License-Identifier: GPL-3.0-or-later
// Level ice as a polygon: areas that can be said beforehand, then ten thousand random breaks.
//
// Tolerances: outlines lie on whole multiples of 2^-30 m: 1e-9 of an area, 1e-8 along an arc, 1e-6
// m2 of a sheet. 1e-12 is rounding of one sum; 0.005 m is half of a last printed digit; 1 % is how
// near the ends a thousand uniform draws come, but once in a million.
#include "solver/level_ice/ice_sheet.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "solver/level_ice/crack_size.hpp"
#include "solver/level_ice/section_outline.hpp"
#include "tests/support/edge_checks.hpp"
#include "tests/support/make_sphere_sets.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;
using ice::test::tolerance;
using test::cross;
using test::is_simple;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSmallest = 0.5;  // [m]

using Box = Eigen::AlignedBox2d;

IceSheet field() { return IceSheet(Box(Vec2(0, -20), Vec2(100, 20)), kSmallest); }

double sum_of(const std::vector<Loop>& loops) {
    double sum = 0.0;
    for (const Loop& loop : loops) sum += area_of(loop);
    return sum;
}

double half_disc(double radius) { return 0.5 * kPi * radius * radius; }

// Ice must be gone from where a piece was.
double left_in(const IceSheet& sheet, const Loop& piece) {
    IceSheet copy = sheet;
    const double before = copy.area();
    copy.break_off(piece);
    return before - copy.area();
}

}  // namespace

TEST_CASE("a crack's outline is a half disc and a strip", "[level_ice][analytic]") {
    const double radius = 4.0, turn = GENERATE(0.0, 1.0, 4.0);
    const Vec2 at(3, -2), inwards(std::cos(turn), std::sin(turn));
    const Loop loop = crack_outline(at, inwards, radius);
    double deepest = 0.0, widest = 0.0, ahead = 0.0;
    for (const Vec2& p : loop) {
        deepest = std::max(deepest, (p - at).dot(inwards));
        ahead = std::min(ahead, (p - at).dot(inwards));
        if (std::abs((p - at).dot(inwards)) < 1e-9)  // the arc's ends
            widest = std::max(widest, std::abs(cross(inwards, p - at)));
    }
    // nine sides of 20 degrees with the area of the half disc: 0.5 s^2 sin(20 deg) = 0.5 r^2 20 deg
    const double reach = radius * std::sqrt((kPi / 9) / std::sin(kPi / 9));
    CHECK(deepest == Near(reach * std::cos(kPi / 18)));  // the middle side's corners
    CHECK(widest == Near(reach));
    CHECK(ahead == Near(-0.5 * radius));
    CHECK(area_of(loop) == Near(0.5 * kPi * radius * radius + reach * radius));
}

TEST_CASE("the radius has the law's length, speed and scatter", "[level_ice]") {
    CrackLaw law;
    CHECK(crack_size(law, 14.6, 0.0, 1) == Near(4.67).margin(0.005));
    CHECK(crack_size(law, 14.6, 1.0, 1) == Near(4.0).margin(0.005));
    CHECK(crack_size(law, 14.6, 50.0, 1) == Near(0.2 * 0.32 * 14.6));
    law.scatter = 0.25;
    double low = 1e9, high = 0.0;
    for (std::uint64_t number = 0; number < 1000; ++number) {
        const double radius = crack_size(law, 14.6, 0.0, number);
        CHECK(radius == crack_size(law, 14.6, 0.0, number));
        low = std::min(low, radius);
        high = std::max(high, radius);
    }
    CHECK(low == Near(0.75 * 4.672).epsilon(0.01));
    CHECK(high == Near(1.25 * 4.672).epsilon(0.01));
    law.seed = 1;
    CHECK(crack_size(law, 14.6, 0.0, 7) != crack_size({0.32, -0.144, 0.25, 0}, 14.6, 0.0, 7));
}

TEST_CASE("a cusp at a straight edge is a half disc", "[level_ice][analytic]") {
    IceSheet sheet = field();
    REQUIRE(sheet.area() == 4000.0);
    const auto broken = sheet.break_off(crack_outline({0, 3}, {1, 0}, 4.0));
    REQUIRE(broken.pieces.size() == 1);
    CHECK(area_of(broken.pieces[0]) == Near(half_disc(4.0)).epsilon(1e-8));
    CHECK(broken.brash == 0.0);
    CHECK(sheet.area() + area_of(broken.pieces[0]) == Near(4000.0).epsilon(1e-12));
    CHECK(left_in(sheet, broken.pieces[0]) == Near(0.0).margin(1e-6));
    CHECK_FALSE(sheet.contains({1, 3}));
    CHECK(sheet.contains({4.1, 3}));
    CHECK(sheet.contains({1, 8}));
}

TEST_CASE("a second cusp beside the first takes what is left there", "[level_ice][analytic]") {
    IceSheet sheet = field();
    sheet.break_off(crack_outline({0, 0}, {1, 0}, 4.0));
    // two equal polygons of nine sides, 4 m apart: their lens is symmetric, so the second loses as
    // much of its half as two of its sectors reach over the middle line
    const auto broken = sheet.break_off(crack_outline({0, 4}, {1, 0}, 4.0));
    REQUIRE(broken.pieces.size() == 1);
    const double lens = 0.5 * (2.0 * 16.0 * std::acos(0.5) - 2.0 * std::sqrt(64.0 - 16.0));
    // the polygons cross their circles, by 1 % of the radius at most: over 8 m of arc that is 2 %
    // of the area at most
    CHECK(area_of(broken.pieces[0]) == Near(0.5 * kPi * 16.0 - lens).epsilon(0.03));
    CHECK(is_simple(sheet.loops()));
}

TEST_CASE("a part that is cut off on all sides comes loose, too", "[level_ice]") {
    IceSheet sheet(Box(Vec2(0, -1), Vec2(100, 1)), kSmallest);
    // across a beam of 2 m, 10 m from its end, with a region of 4 m2
    const auto broken = sheet.break_off({{10, -2}, {11, -2}, {11, 2}, {10, 2}});
    REQUIRE(broken.pieces.size() == 2);
    CHECK(area_of(broken.pieces[0]) == Near(20.0));
    CHECK(area_of(broken.pieces[1]) == Near(2.0));
    CHECK(sheet.area() == Near(178.0));
    // 29 m from the new end: both parts are sheets
    CHECK(sheet.break_off({{40, -2}, {41, -2}, {41, 2}, {40, 2}}).pieces.size() == 1);
    CHECK(sheet.loops().size() == 2);
    CHECK(sheet.area() == Near(176.0));
    CHECK(sheet.contains({20, 0}));
}

TEST_CASE("what is too small or too thin for a piece is brash", "[level_ice]") {
    IceSheet sheet = field();
    auto broken = sheet.break_off({{-1, 0}, {0.3, 0}, {0.3, 0.4}, {-1, 0.4}});
    CHECK(broken.pieces.empty());
    CHECK(broken.brash == Near(0.12));
    broken = sheet.break_off({{-1, 5}, {0.05, 5}, {0.05, 15}, {-1, 15}});  // 0.05 by 10 m
    CHECK(broken.pieces.empty());
    CHECK(broken.brash == Near(0.5));
    CHECK(sheet.area() == Near(4000.0 - 0.62));
    CHECK(sheet.break_off({{-3, 0}, {-1, 0}, {-1, 2}}).pieces.empty());  // beside the ice
}

TEST_CASE("a piece of exactly the least area is a piece, and equal ones come in one order",
          "[level_ice][analytic]") {
    IceSheet sheet(Box(Vec2(0, -20), Vec2(100, 20)), 1.0);
    auto broken = sheet.break_off({{-1, 0}, {1, 0}, {1, 1}, {-1, 1}});
    REQUIRE(broken.pieces.size() == 1);
    CHECK(area_of(broken.pieces[0]) == 1.0);
    CHECK(broken.brash == 0.0);
    // open water parts what a crack takes into two equal squares; Clipper names the one at larger y
    // first, and sorting keeps that
    sheet.take({{-1, 4}, {2, 4}, {2, 6}, {-1, 6}});
    broken = sheet.break_off({{-1, 2}, {2, 2}, {2, 8}, {-1, 8}});
    REQUIRE(broken.pieces.size() == 2);
    CHECK(area_of(broken.pieces[0]) == area_of(broken.pieces[1]));
    CHECK(centroid_of(broken.pieces[0]).y() == Near(7.0));
    CHECK(centroid_of(broken.pieces[1]).y() == Near(3.0));
}

TEST_CASE("a load inside the ice makes a hole, and a ring around it breaks in two", "[level_ice]") {
    IceSheet sheet = field();
    const Loop square{{40, -2}, {44, -2}, {44, 2}, {40, 2}},
        around{{38, -4}, {46, -4}, {46, 4}, {38, 4}};
    CHECK(sheet.break_off(square).pieces.size() == 1);
    REQUIRE(sheet.loops().size() == 2);
    CHECK(area_of(sheet.loops()[1]) == Near(-16.0));
    // 8 m by 8 m without 4 m by 4 m, cut at the hole's middle
    const auto ring = sheet.break_off(around);
    REQUIRE(ring.pieces.size() == 2);
    CHECK(is_simple(ring.pieces));
    for (const Loop& half : ring.pieces) CHECK(area_of(half) == Near(24.0));
    CHECK(ring.brash == 0.0);
    REQUIRE(sheet.loops().size() == 2);
    CHECK(sheet.area() == Near(4000.0 - 64.0));
    CHECK_FALSE(sheet.contains({39, 0}));
    CHECK(sheet.contains({37, 0}));
}

TEST_CASE("a ring with two holes breaks in parts without any", "[level_ice]") {
    IceSheet sheet = field();
    for (const double x : {40.0, 50.0}) sheet.break_off({{x, -2}, {x + 4, -2}, {x + 4, 2}, {x, 2}});
    REQUIRE(sheet.loops().size() == 3);
    const auto broken = sheet.break_off({{38, -4}, {56, -4}, {56, 4}, {38, 4}});
    CHECK(broken.pieces.size() == 3);
    CHECK(sum_of(broken.pieces) == Near(18.0 * 8.0 - 32.0));
    CHECK(sheet.area() + sum_of(broken.pieces) == Near(4000.0 - 32.0).epsilon(1e-12));
}

TEST_CASE("random breaks keep the area, the polygon and a least size of pieces",
          "[level_ice][fuzz][long]") {
    std::mt19937 random(29);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    IceSheet sheet = field(), twin = field();
    double broken_area = 0.0;
    int fields = 1;
    for (int k = 0; k < 10000; ++k) {
        if (sheet.loops().empty() || sheet.area() < 1000.0) {
            sheet = twin = field();
            broken_area = 0.0;
            ++fields;
        }
        // a place on an edge, or a little beside it, and any direction
        const Loop& loop = sheet.loops()[static_cast<std::size_t>(
            unit(random) * static_cast<double>(sheet.loops().size()))];
        const auto corner =
            static_cast<std::size_t>(unit(random) * static_cast<double>(loop.size()));
        const double along = k % 3 == 0 ? 0.0 : unit(random), turn = 2.0 * kPi * unit(random);
        const Vec2 at = loop[corner] + along * (loop[(corner + 1) % loop.size()] - loop[corner]) +
                        (k % 5 == 0 ? 0.3 : 0.0) * Vec2(unit(random), unit(random));
        const Loop crack =
            crack_outline(at, Vec2(std::cos(turn), std::sin(turn)), 0.3 + 5.0 * unit(random));
        const IceSheet::Broken broken = sheet.break_off(crack);
        for (const Loop& piece : broken.pieces) {
            REQUIRE(area_of(piece) >= kSmallest * kSmallest);
            REQUIRE(2.0 * area_of(piece) >= 0.25 * kSmallest * length_of(piece));
        }
        broken_area += sum_of(broken.pieces) + broken.brash;
        REQUIRE(std::abs(sheet.area() + broken_area - 4000.0) <= tolerance(1e-9) * 4000.0);
        for (std::size_t other = 1; other < sheet.loops().size(); ++other)
            REQUIRE(area_of(sheet.loops()[other]) <= area_of(sheet.loops()[0]));
        // twice the same, also from what a checkpoint holds
        if (k % 2 == 0) twin.restore(std::vector<Loop>(twin.loops()));
        twin.break_off(crack);
        REQUIRE(twin.loops() == sheet.loops());
        if (k % 50 != 0) continue;
        REQUIRE(is_simple(sheet.loops()));
        for (const Loop& piece : broken.pieces) {
            REQUIRE(is_simple({piece}));
            REQUIRE(left_in(sheet, piece) <= tolerance(1e-6));  // 1 nm around it, and by rounding
        }
    }
    CHECK(fields > 10);
}

TEST_CASE("what is taken away, what is in a box and what two loops share add up", "[level_ice]") {
    IceSheet sheet = field();
    const Box box(Vec2(-1, -2), Vec2(5, 3));
    CHECK(sheet.area_in(loop_of(box)) == Near(25.0));
    CHECK(sheet.in_box(box).area() == Near(25.0));
    CHECK(sheet.parts_in(box).size() == 1);
    CHECK(sheet.take(loop_of(box)) == Near(25.0).epsilon(1e-9));
    CHECK(sheet.area() == Near(4000.0 - 25.0));
    CHECK(sheet.area_in(loop_of(box)) == Near(0.0).margin(1e-9));
    // around a hole two parts
    sheet.take(loop_of(Box(Vec2(50, -1), Vec2(52, 1))));
    const auto parts = sheet.parts_in(Box(Vec2(45, -5), Vec2(55, 5)));
    CHECK(parts.size() == 2);
    CHECK(sum_of(parts) == Near(96.0));
    const Loop square = loop_of(Box(Vec2(0, 0), Vec2(2, 2))),
               other = loop_of(Box(Vec2(1, 0), Vec2(4, 2)));
    CHECK(sum_of(common_part(square, other)) == Near(2.0));
    CHECK(sum_of(without(square, other)) == Near(2.0));
    const Loop beside = loop_of(Box(Vec2(2, 0), Vec2(3, 1)));
    CHECK(area_of(joined(square, beside)) == Near(5.0));
    CHECK(joined(square, loop_of(Box(Vec2(5, 5), Vec2(6, 6)))).empty());
}

TEST_CASE("a loop that shrinks loses a strip, and what becomes too thin", "[level_ice]") {
    const Loop square{{0, 0}, {4, 0}, {4, 4}, {0, 4}};
    const auto smaller = shrunk(square, 0.1, kSmallest, 1e-3);
    REQUIRE(smaller.size() == 1);
    CHECK(area_of(smaller[0]) == Near(3.8 * 3.8));
    CHECK(shrunk(square, 2.1, kSmallest, 1e-3).empty());
    // two squares joined by a neck of 0.1 m
    const Loop neck{{0, 0},  {4, 0}, {4, 1.95}, {6, 1.95}, {6, 0}, {10, 0},
                    {10, 4}, {6, 4}, {6, 2.05}, {4, 2.05}, {4, 4}, {0, 4}};
    CHECK(shrunk(neck, 0.1, kSmallest, 1e-3).size() == 2);
}

TEST_CASE("a hull's outline is the convex hull of its section", "[level_ice][analytic]") {
    const Loop box = section_outline(test::make_box_mesh(Vec3(6, 2, 3)), 0.4);
    REQUIRE(box.size() == 4);
    CHECK(area_of(box) == Near(12.0));
    CHECK(section_outline(test::make_box_mesh(Vec3(6, 2, 3)), 2.0).empty());
}
