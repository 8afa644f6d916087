// SPDX-License-Identifier: GPL-3.0-or-later
// Where convex solids meet: polygons by hand.
#include "solver/narrow/feature/contact_polygon.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "solver/narrow/manifold/find_polygon.hpp"
#include "solver/shape/cut_solid.hpp"
#include "tests/support/make_prisms.hpp"
#include "tests/support/make_sphere_sets.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;
using ice::test::tolerance;

namespace {

constexpr double kAll = std::numeric_limits<double>::infinity();

ConvexPiece box(const Vec3& size) { return make_convex_piece(test::make_box_mesh(size)); }

ContactPolygon meet(const ConvexPiece& a, const ConvexPiece& b, const RelativePose& pose,
                    double most) {
    ContactPolygon out;
    ClippingWork work;
    make_contact_polygon(a, b, pose, find_axes(a, b, pose, kAll), IncidentFaces::all, most, work,
                         out);
    if (!out.corners.empty()) order_around(out);
    return out;
}

// Area of the polygon whose corners these are, seen along n.
double area_of(const ContactPolygon& polygon) {
    Vec3 sum = Vec3::Zero();
    const auto& corners = polygon.corners;
    for (std::size_t k = 0; k < corners.size(); ++k)
        sum += 0.5 * corners[k].point.cross(corners[(k + 1) % corners.size()].point);
    return std::abs(sum.dot(polygon.normal));
}

}  // namespace

TEST_CASE("boxes on each other meet in the rectangle that they share", "[narrow][analytic]") {
    const double gap = GENERATE(0.001, 0.0, -0.02);
    const ConvexPiece a = box(Vec3(4, 2, 1)), b = box(Vec3(3, 3, 1));
    // b reaches from x = 0.5 to 3.5 and over both sides of a
    const ContactPolygon polygon = meet(a, b, {Mat3::Identity(), Vec3(2.0, 0.2, 1.0 + gap)}, 0.01);
    CHECK(polygon.normal == Vec3::UnitZ());
    REQUIRE(polygon.corners.size() == 4);
    for (const PolygonCorner& c : polygon.corners) {
        CHECK(c.gap == Near(gap).margin(1e-15));
        CHECK(c.point.z() == Near(0.5 + 0.5 * gap).margin(1e-15));
    }
    // side planes have a slack of 0.1 mm, and what has not touched may come from beside by its gap
    CHECK(area_of(polygon) == Near(1.5 * 2.0).margin(5.0 * (1e-4 + std::max(gap, 0.0))));
    std::set<std::uint64_t> ids;
    for (const PolygonCorner& c : polygon.corners) ids.insert(c.id);
    CHECK(ids.size() == 4);
}

TEST_CASE("a tilted box meets a face along its lower edge, one on its corner in a point",
          "[narrow][analytic]") {
    const ConvexPiece plate = box(Vec3(10, 10, 1)), cube = box(Vec3(1, 1, 1));
    const double tilt = 0.3, depth = 0.01;
    Mat3 turn = Eigen::AngleAxisd(tilt, Vec3::UnitY()).toRotationMatrix();
    const double low = 0.5 * (std::cos(tilt) + std::sin(tilt));
    ContactPolygon polygon = meet(plate, cube, {turn, Vec3(0, 0, 0.5 + low - depth)}, 0.001);
    REQUIRE(polygon.corners.size() == 2);
    for (const PolygonCorner& c : polygon.corners) {
        CHECK(c.gap == Near(-depth).epsilon(1e-12));
        CHECK(std::abs(c.point.y()) == Near(0.5).epsilon(1e-12));
    }
    turn = Eigen::Quaterniond::FromTwoVectors(Vec3(1, 1, 1), Vec3(0, 0, -1)).toRotationMatrix();
    polygon = meet(plate, cube, {turn, Vec3(0, 0, 0.5 + std::sqrt(0.75) - depth)}, 0.001);
    REQUIRE(polygon.corners.size() == 1);
    CHECK(polygon.corners[0].gap == Near(-depth).epsilon(1e-12));
    CHECK(polygon.corners[0].point.head<2>().norm() < tolerance(1e-12));
    // seen from the other body it is the same
    const ContactPolygon back = meet(
        cube, plate,
        {turn.transpose(), -(turn.transpose() * Vec3(0, 0, 0.5 + std::sqrt(0.75) - depth))}, 0.001);
    REQUIRE(back.corners.size() == 1);
    CHECK(back.corners[0].gap == Near(-depth).epsilon(1e-12));
    CHECK((turn * back.normal + Vec3::UnitZ()).norm() < tolerance(1e-12));
}

TEST_CASE("edges that cross meet midway between them where they cross", "[narrow][analytic]") {
    const ConvexPiece cube = box(Vec3(2, 2, 2));
    const double gap = GENERATE(-0.05, 0.002);
    const Vec3 n = Vec3(1, 0, 1).normalized();
    Mat3 turn;
    turn.col(0) = (-n - Vec3::UnitY()).normalized();
    turn.col(1) = (-n + Vec3::UnitY()).normalized();
    turn.col(2) = turn.col(0).cross(turn.col(1));
    const Vec3 at(1, 0.3, 1);
    const ContactPolygon polygon =
        meet(cube, cube, {turn, at + gap * n - turn * Vec3(1, 1, 0.2)}, 0.01);
    REQUIRE(polygon.corners.size() == 1);
    CHECK(polygon.corners[0].gap == Near(gap).epsilon(1e-12));
    CHECK((polygon.corners[0].point - (at + 0.5 * gap * n)).norm() < tolerance(1e-14));
    CHECK((polygon.normal - n).norm() < tolerance(1e-15));
}

TEST_CASE("floes on each other with a small twist meet in a polygon, though edges separate them",
          "[narrow][property]") {
    // With the edges' one point they rocked, and in a basin of floes came 0.22 m into each other.
    test::Dice dice{std::mt19937(7)};
    const ConvexPiece floe = box(Vec3(1, 0.8, 0.3));
    int by_edges = 0;
    for (int k = 0; k < 2000; ++k) {
        const Vec3 turn = 0.02 * dice.vector();
        const double depth = 0.03;
        const RelativePose pose{
            Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix(),
            Vec3(0.1 * dice.number(), 0.1 * dice.number(), 0.3 - depth)};
        const SeparatingAxes axes = find_axes(floe, floe, pose, kAll);
        if (!is_edge_axis(axes)) continue;
        ++by_edges;
        const ContactPolygon polygon = meet(floe, floe, pose, 0.001);
        CAPTURE(k, axes.edges, axes.face_a, axes.face_b, turn.transpose());
        // the faces share 0.9 by 0.7 m at least
        REQUIRE(polygon.corners.size() >= 4);
        REQUIRE(area_of(polygon) > 0.6);
    }
    REQUIRE(by_edges > 100);
}

TEST_CASE("a side that was crushed at both ends meets a face with both", "[narrow][analytic]") {
    // The side x = 0.5 lost a corner at either end, to planes that differ by a twenty-fifth. Turned
    // by less, the floe has its deepest corner in one of these facets, and the other end overlaps.
    ConvexPiece floe = box(Vec3(1, 0.8, 0.3));
    for (const double side : {-1.0, 1.0})
        REQUIRE(crush_solid(floe, Vec3(1, 0.02 * side, 0).normalized(), Vec3(0.5, 0.1 * side, 0)));
    const ConvexPiece wall = box(Vec3(1, 2, 1));
    for (const double turn : {-0.015, 0.015}) {
        const Mat3 turned = Eigen::AngleAxisd(turn, Vec3::UnitZ()).toRotationMatrix();
        const RelativePose pose{turned, Vec3(-0.98, 0.0, 0.0)};
        ContactPolygon polygon;
        ClippingWork work;
        find_polygon({wall, floe, pose}, find_axes(wall, floe, pose, kAll), 0.001, {}, work,
                     polygon);
        REQUIRE(polygon.normal == -Vec3::UnitX());
        REQUIRE(polygon.corners.size() == 4);
        const auto [low, high] = std::minmax_element(
            polygon.corners.begin(), polygon.corners.end(),
            [](const auto& l, const auto& r) { return l.point.y() < r.point.y(); });
        CHECK(high->point.y() - low->point.y() > 0.75);
    }
}

TEST_CASE("pressed corners come before open ones, and outer before inner ones",
          "[narrow][analytic]") {
    // a side of 0.5 m overlaps by 1 mm, the sides next to it are open by 2 mm at their ends
    const ConvexPiece wall = box(Vec3(1, 2, 1));
    ConvexPiece floe = box(Vec3(1, 0.8, 0.3));
    for (const double side : {-1.0, 1.0})
        REQUIRE(crush_solid(floe, Vec3(1, 0.02 * side, 0).normalized(), Vec3(0.5, 0.25 * side, 0)));
    const RelativePose pose{Mat3::Identity(), Vec3(-0.999, 0.0, 0.0)};
    ContactPolygon polygon;
    ClippingWork work;
    find_polygon({wall, floe, pose}, find_axes(wall, floe, pose, kAll), 0.005, {}, work, polygon);
    REQUIRE(polygon.corners.size() == 4);
    for (const PolygonCorner& c : polygon.corners) CHECK(c.gap == Near(-1e-3).margin(2e-4));
    // the front of a thin piece that is deep in a face, and not its back
    const ConvexPiece deck = box(Vec3(1, 0.8, 0.3)), chip = box(Vec3(0.5, 0.4, 0.02));
    const RelativePose deep{Mat3::Identity(), Vec3(0, 0, 0.13)};
    find_polygon({deck, chip, deep}, find_axes(deck, chip, deep, kAll), 0.001, {}, work, polygon);
    REQUIRE(polygon.corners.size() == 4);
    for (const PolygonCorner& c : polygon.corners) CHECK(c.gap == Near(-0.03).epsilon(1e-9));
}

TEST_CASE("no corner is deeper than the penetration, one of each overlap is as deep",
          "[narrow][property]") {
    test::Dice dice{std::mt19937(31)};
    std::vector<ConvexPiece> pieces;
    for (int k = 0; k < 20; ++k)
        pieces.push_back(make_convex_piece(test::make_random_frustum(dice, 3 + k % 4)));
    for (int k = 0; k < 5000; ++k) {
        const ConvexPiece& a = pieces[static_cast<std::size_t>(k) % 20];
        const ConvexPiece& b = pieces[static_cast<std::size_t>(k / 3) % 20];
        const RelativePose pose{
            Eigen::AngleAxisd(3.1 * dice.number(), dice.vector().normalized()).toRotationMatrix(),
            1.5 * dice.vector()};
        const double gap = find_axes(a, b, pose, kAll).widest();
        ContactPolygon polygon = meet(a, b, pose, 0.0);
        double least = kAll;
        for (const PolygonCorner& c : polygon.corners) least = std::min(least, c.gap);
        if (gap > 0.0) continue;
        REQUIRE(least >= gap);
        // in place of two edges a face that is as deep by kPrefer
        const bool edges = is_edge_axis(find_axes(a, b, pose, kAll));
        REQUIRE(least <= gap + (edges ? PolygonTolerances::kPrefer : 0.0) + tolerance(1e-9));
        reduce_polygon(kManifoldCorners, polygon);
        REQUIRE(polygon.corners.size() <= kManifoldCorners);
        REQUIRE(std::any_of(polygon.corners.begin(), polygon.corners.end(),
                            [&](const PolygonCorner& c) { return c.gap == least; }));
    }
}

TEST_CASE("a polygon reduced to four corners keeps most of its area", "[narrow][analytic]") {
    const auto n = GENERATE(5u, 8u, 30u);
    ContactPolygon polygon;
    polygon.normal = Vec3::UnitZ();
    for (unsigned k = 0; k < n; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / n;
        polygon.corners.push_back(
            {Vec3(std::cos(angle), std::sin(angle), 0), k == 3 ? -0.1 : 0.0, k});
    }
    const double before = area_of(polygon);
    reduce_polygon(4, polygon);
    REQUIRE(polygon.corners.size() == 4);
    CHECK(std::any_of(polygon.corners.begin(), polygon.corners.end(),
                      [](const PolygonCorner& c) { return c.gap == -0.1; }));
    // a square in a circle has 2 / pi of its area; taken one by one they do not become a square
    CHECK(area_of(polygon) > 0.5 * before);
}

TEST_CASE("two edges keep their axis unless a face has nearly the same", "[narrow][property]") {
    test::Dice dice{std::mt19937(19)};
    int faces = 0, edges = 0;
    for (int k = 0; k < 20000; ++k) {
        const ConvexPiece floe = box(Vec3(1, 0.8, 0.3));
        const Vec3 turn = (k % 2 == 0 ? 1.0 : 0.05) * dice.vector();
        const RelativePose pose{
            Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix(),
            0.5 * dice.vector()};
        const SeparatingAxes axes = find_axes(floe, floe, pose, kAll);
        if (!is_edge_axis(axes) || axes.widest() > 0.01) continue;
        const ContactPolygon polygon = meet(floe, floe, pose, 0.01);
        if (polygon.corners.empty()) continue;
        const Vec3 axis = edge_axis(floe, floe, pose, axes.edge_a, axes.edge_b);
        const double angle = 2.0 * std::asin(0.5 * (polygon.normal - axis).norm());
        REQUIRE(angle < PolygonTolerances::kSameAxis + tolerance(1e-9));
        ++(angle > 1e-9 ? faces : edges);
        // one corner has the gap of the two edges, whether they overlap or not
        double least = kAll;
        for (const PolygonCorner& c : polygon.corners) least = std::min(least, c.gap);
        REQUIRE(std::abs(least - axes.widest()) <= PolygonTolerances::kPrefer);
    }
    CHECK(faces > 100);
    CHECK(edges > 100);
}
