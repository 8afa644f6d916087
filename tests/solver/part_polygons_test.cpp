// SPDX-License-Identifier: GPL-3.0-or-later
// Hollow prisms in convex parts: they meet like the whole solids, and cuts between parts are no
// surface.
#include "solver/narrow/feature/part_polygons.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "preprocess/field/make_prism.hpp"
#include "preprocess/slice/convex_parts.hpp"
#include "solver/live_edge/prism_parts.hpp"
#include "solver/narrow/find_contacts.hpp"
#include "tests/support/dice.hpp"
#include "tests/support/make_worlds.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;
using ice::test::tolerance;

namespace {

// Rounding of coordinates of some metres over some tens of operations [m].
constexpr double kRounding = 1e-12;

// 4 x 4 m without the quarter of positive x and y: the hollow corner is the origin.
const Loop kAngle{{-2, -2}, {2, -2}, {2, 0}, {0, 0}, {0, 2}, {-2, 2}};
// A channel between two arms: its floor is y = 0, its walls x = -1 and x = 1.
const Loop kFork{{-2, -1}, {2, -1}, {2, 2}, {1, 2}, {1, 0}, {-1, 0}, {-1, 2}, {-2, 2}};

Loop box(double length, double breadth) {
    const double x = 0.5 * length, y = 0.5 * breadth;
    return {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
}

// A half disc less another one that is moved outwards: as ice breaks off behind earlier notches.
Loop random_crescent(test::Dice& dice) {
    const int sides = 9;
    const double inner = 0.7 + 0.2 * dice.number(), depth = 0.25 + 0.2 * dice.number();
    Loop out;
    for (int k = 0; k <= sides; ++k) {
        const double turn = std::numbers::pi * k / sides;
        out.emplace_back(2.0 * std::cos(turn), 2.0 * std::sin(turn));
    }
    for (int k = 5; k >= 0; --k) {
        const double turn = std::numbers::pi * (k + 0.3 * dice.number()) / 5;
        out.emplace_back(1.8 * inner * std::cos(turn), 2.0 * depth * std::sin(turn));
    }
    return out;
}

std::vector<MetCorner> meet(const Loop& a, const Loop& b, const RelativePose& pose, double most) {
    PartsWork work;
    std::vector<MetCorner> out;
    find_part_polygons(prism_parts(a, 1.0), prism_parts(b, 1.0), pose, most, work, out);
    return out;
}

RelativePose upright(double x, double y, double turn = 0.0) {
    return {Mat3(Eigen::AngleAxisd(turn, Vec3::UnitZ())), Vec3(x, y, 0.0)};
}

// The parts with their cuts as planes and edges like all others.
std::vector<ConvexPiece> whole_parts(const Loop& outline) {
    std::vector<ConvexPiece> out;
    for (const auto& corners : convex_parts(outline)) {
        Loop loop;
        for (const std::int32_t k : corners) loop.push_back(outline[static_cast<std::size_t>(k)]);
        out.push_back(make_convex_piece(make_prism(loop, 1.0, 0.0)));
    }
    return out;
}

// How far two solids are apart, or how deep in each other, by all pairs of parts [m].
double separation_of(const std::vector<ConvexPiece>& a, const std::vector<ConvexPiece>& b,
                     const RelativePose& pose) {
    double least = std::numeric_limits<double>::infinity();
    for (const ConvexPiece& pa : a)
        for (const ConvexPiece& pb : b)
            least = std::min(least, find_axes(pa, pb, pose, 1e9).widest());
    return least;
}

}  // namespace

TEST_CASE("convex parts have the outline's area and turn left only", "[shape][analytic]") {
    test::Dice dice{std::mt19937(3)};
    for (const Loop& outline : {kAngle, kFork, box(3, 2), random_crescent(dice)}) {
        double area = 0.0;
        for (const auto& corners : convex_parts(outline)) {
            Loop part;
            for (const std::int32_t k : corners)
                part.push_back(outline[static_cast<std::size_t>(k)]);
            area += area_of(part);
            for (std::size_t k = 0; k < part.size(); ++k) {
                const Vec2 before = part[(k + 1) % part.size()] - part[k],
                           after = part[(k + 2) % part.size()] - part[(k + 1) % part.size()];
                CHECK(before.x() * after.y() - before.y() * after.x() >= 0.0);
            }
        }
        CHECK(area == Near(area_of(outline)).epsilon(1e-14));
    }
    CHECK(convex_parts(kAngle).size() == 2);
    CHECK(convex_parts(kFork).size() == 3);
    CHECK(prism_parts(box(3, 2), 1.0).size() == 1);
    CHECK(convex_parts({{0, 0}, {1, 1}, {1, 0}, {0, 1}}).empty());  // crosses itself
}

TEST_CASE("parts keep the prism's faces, and cuts are marked", "[shape][analytic]") {
    for (const Loop& outline : {kAngle, kFork}) {
        std::size_t sides = 0;
        for (const SolidPart& part : prism_parts(outline, 1.0)) {
            CHECK(!part.cuts.empty());
            sides += part.solid.plane_count() - 2;  // less top and bottom
            for (std::size_t k = 0; k < part.solid.corners.size(); ++k)
                CHECK((part.solid.corners[k] - part.middle).norm() <=
                      part.radius + tolerance(kRounding));
        }
        CHECK(sides == outline.size());
    }
}

TEST_CASE("a box in a hollow corner meets both sides, at the true gaps", "[shape][analytic]") {
    const double gap = GENERATE(1e-3, 0.0, -2e-3);
    const auto met = meet(kAngle, box(1, 1), upright(0.5 + gap, 0.5 + 0.5 * gap), 5e-3);
    int along_x = 0, along_y = 0;
    for (const auto& [corner, normal, section, crushes_a] : met) {
        if ((normal - Vec3::UnitX()).norm() < tolerance(kRounding)) {
            ++along_x;
            CHECK(corner.gap == Near(gap).margin(kRounding));
        } else {
            ++along_y;
            CHECK((normal - Vec3::UnitY()).norm() < tolerance(kRounding));
            CHECK(corner.gap == Near(0.5 * gap).margin(kRounding));
        }
    }
    CHECK(along_x == 4);
    CHECK(along_y == 4);
}

TEST_CASE("a sharp horn meets a face with its tip", "[shape][analytic]") {
    // 15 degrees: no face of the horn is turned against the box's by more than 8
    const Loop horned{{-2, -1}, {0, -1}, {0, -0.13}, {1, 0}, {0, 0.13}, {0, 1}, {-2, 1}};
    const double gap = GENERATE(1e-4, -1e-3);
    const auto met = meet(horned, box(1, 1), upright(1.5 + gap, 0.1), 1e-3);
    REQUIRE(met.size() == 2);
    for (const auto& [corner, normal, section, crushes_a] : met) {
        CHECK((normal - Vec3::UnitX()).norm() < tolerance(kRounding));
        CHECK(corner.gap == Near(gap).margin(kRounding));
        CHECK(std::abs(corner.point.y()) < 1e-3);
    }
}

TEST_CASE("a box that slides over cuts meets nothing along its way", "[shape][analytic]") {
    // below the fork, from side to side, past the ends of both cuts
    const double gap = 1e-4;
    for (double x = -2.4; x <= 2.4; x += 0.0373) {
        const auto met = meet(kFork, box(1, 1), upright(x, -1.5 - gap), 0.05);
        REQUIRE(met.size() >= 4);
        for (const auto& [corner, normal, section, crushes_a] : met) {
            CHECK((normal + Vec3::UnitY()).norm() < tolerance(kRounding));
            CHECK(corner.gap == Near(gap).margin(kRounding));
        }
        CHECK(met.size() == 4);
    }
    // on top of it, tilted a little about its way: contacts stay below, with the top's normal
    for (double x = -2.4; x <= 2.4; x += 0.0373) {
        const Mat3 tilt(Eigen::AngleAxisd(1e-3, Vec3::UnitX()));
        const auto met = meet(kFork, box(1, 1), {tilt, Vec3(x, -0.5, 1.0 + 6e-4)}, 0.05);
        REQUIRE(!met.empty());
        CAPTURE(x);
        for (const auto& [corner, normal, section, crushes_a] : met) {
            CAPTURE(corner.gap, normal.transpose(), corner.point.transpose());
            CHECK(normal.z() > 0.99);
        }
    }
}

TEST_CASE("pieces of level ice meet each other as rigid whole solids", "[narrow][analytic]") {
    const Vec3 size(2, 2, 1);
    const double deep = 0.01;  // [m]
    World w = test::plate_world(test::empty_space(0.01), Vec3(4, 2, 1), 0.25, 0.5, 100.0);
    const auto row = test::add_shape(w, test::make_box_set(size, 0.25, 0.5));
    w.scene.shapes[static_cast<std::size_t>(row)].parts = prism_parts(box(2, 2), 1.0);
    for (int k = 0; k < 2; ++k)
        add_floe(w.scene, row, 900.0, k * Vec3(2.0 - deep, 0, 0), Quaternion::Identity(), 0, false);
    const std::vector<BodyPair> pairs{{1, 2}};
    const ContactRule rule(NormalRule::surface, true);
    std::vector<Contact> contacts;
    ContactFinder().find(w.scene, pairs, rule, 0.01, 1e-3, contacts);
    REQUIRE(contacts.size() == 4);
    for (const Contact& c : contacts) {
        CHECK(c.is_of_solids());
        CHECK(c.normal == Vec3::UnitX());
        CHECK(c.gap == Near(-deep).margin(kRounding));
    }
    // the ship has crushed the first one there: that leaves no room for the second one
    const std::size_t spheres = w.scene.shapes[static_cast<std::size_t>(row)].center.size();
    for (std::size_t k = 0; k < spheres; ++k)
        w.scene.crushed.crush(1, static_cast<std::int32_t>(k), spheres, Vec3(-deep, 0, 0));
    std::vector<Contact> crushed;
    ContactFinder().find(w.scene, pairs, rule, 0.01, 1e-3, crushed);
    REQUIRE(crushed.size() == contacts.size());
    for (std::size_t k = 0; k < crushed.size(); ++k) CHECK(crushed[k].gap == contacts[k].gap);
}

TEST_CASE("an edge over a hollow corner meets the rims of both parts", "[shape][analytic]") {
    // Seen between two pieces beside a hull: a rim of `tip` crosses the rims of `hollow` beyond
    // the ends that they have at the hollow corner, so that each part leaves the contact to the
    // other one.
    const Loop tip{{2.85, -0.54}, {2.0, 0.84}, {0.5, 0.5}, {1.5, -1.5}};
    const Loop hollow{{-1.49, -0.58}, {1.24, -1.96}, {2, 1}, {-3.18, 1.47}, {-2.36, 0.82}};
    const Vec3 turn(-0.476, -0.069, 0.053);
    for (const double x : {4.42, 4.46, 4.5}) {
        const RelativePose pose{Mat3(Eigen::AngleAxisd(turn.norm(), turn.normalized())),
                                Vec3(x, -0.19, -0.41)};
        const double by = separation_of(whole_parts(tip), whole_parts(hollow), pose);
        REQUIRE(by < -0.05);
        const auto met = meet(tip, hollow, pose, 1e-3);
        REQUIRE(met.size() == 2);
        CHECK(std::min(met[0].corner.gap, met[1].corner.gap) == Near(by).margin(kRounding));
        CHECK(met[0].normal.dot(met[1].normal) < 0.8);
        const Vec3 corner = pose.rotation * Vec3(-2.36, 0.82, 0.5) + pose.translation;
        for (const MetCorner& c : met) CHECK((c.corner.point - corner).norm() < -2.0 * by);
    }
}

TEST_CASE("crescents have contacts where they overlap, and none where they are apart",
          "[shape][twin]") {
    test::Dice dice{std::mt19937(11)};
    const double rounding = 1e-9, deep = 0.1;  // [m]
    int apart = 0, overlapping = 0, deeper = 0, unseen = 0, deepest = 0, lost = 0;
    for (int n = 0; n < 4000; ++n) {
        const Loop a = random_crescent(dice), b = random_crescent(dice);
        const Vec3 axis(dice.number(), dice.number(), dice.number());
        const RelativePose pose{
            Mat3(Eigen::AngleAxisd((n % 2 ? 3.0 : 0.3) * dice.number(), axis.normalized())),
            Vec3(3.5 * dice.number(), 3.5 * dice.number(), 0.9 * dice.number())};
        const double by = separation_of(whole_parts(a), whole_parts(b), pose);
        if (std::abs(by) < rounding) continue;
        // a face that is nearly upright to the reference gives no deeper corner than there is
        const auto met = meet(a, b, pose, by > 0.0 ? 0.3 : 0.0);
        CAPTURE(n, by);
        const auto least = std::min_element(
            met.begin(), met.end(),
            [](const MetCorner& l, const MetCorner& r) { return l.corner.gap < r.corner.gap; });
        if (by > 0.0) {
            ++apart;
            CHECK((met.empty() || least->corner.gap > -rounding));
        } else if (by > -deep) {
            ++overlapping;
            CHECK(!met.empty());
        } else if (by > -0.5) {
            ++deeper;
            const bool seen = !met.empty() && least->corner.gap < 0.5 * by;
            unseen += !seen;
        } else {
            // beyond half the thickness the widest axis may be that of edges that do not meet
            ++deepest;
            lost += met.empty();
        }
    }
    CHECK(apart > 500);
    CHECK(overlapping > 100);
    CHECK(deeper > 500);
    CHECK(unseen == 0);
    CHECK(deepest > 500);
    CHECK(lost < 0.03 * deepest);
}
