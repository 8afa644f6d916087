// SPDX-License-Identifier: GPL-3.0-or-later
// Where convex solids meet: polygons by hand, and bodies however deep they are in each other.
#include "solver/narrow/feature/contact_polygon.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <tuple>

#include "solver/integrate/rotation.hpp"
#include "solver/narrow/feature/nearest_sphere.hpp"
#include "solver/narrow/find_contacts.hpp"
#include "solver/narrow/manifold/find_polygon.hpp"
#include "solver/shape/cut_solid.hpp"
#include "tests/support/make_prisms.hpp"
#include "tests/support/make_worlds.hpp"
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

// Two boxes of this size, bodies 1 and 2, far from the hull, the second so far from the first.
World two_boxes(const Vec3& size, double radius, double spacing, const Vec3& apart) {
    World w = test::plate_world(test::empty_space(0.01), Vec3(4, 2, 1), 0.25, 0.5, 100.0);
    const auto row = test::add_shape(w, test::make_box_set(size, radius, spacing));
    for (int k = 0; k < 2; ++k)
        add_floe(w.scene, row, 900.0, k * apart, Quaternion::Identity(), 0, false);
    return w;
}

double deepest(const std::vector<Contact>& contacts) {
    double gap = 0.0;
    for (const Contact& c : contacts) gap = std::min(gap, c.gap);
    return gap;
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

TEST_CASE("a pair stays found whatever its depth, with its true depth and the shortest way out",
          "[narrow][analytic]") {
    // spheres alone lose such boxes from two radii, 0.5 m, on
    const Vec3 size(8, 4, 1);
    const bool crushes = GENERATE(false, true);
    const double depth = GENERATE(0.05, 0.2, 0.4, 0.48, 0.52, 0.7, 0.9);
    const int axis = GENERATE(0, 1, 2);
    if (axis < 2 && depth > 0.48) return;  // deeper, a metre thick, they part upwards
    Vec3 apart = Vec3(0.3, 0.2, 0.1) * (depth > 0.45 ? 0.1 : 1.0);
    apart[axis] = size[axis] - depth;
    const World w = two_boxes(size, 0.25, 0.7, apart);
    std::vector<Contact> found, expected;
    ContactFinder().find(w.scene, {{1, 2}}, {NormalRule::surface, crushes}, 0.0, 0.0, found);
    reference::find_contacts(w.scene, {1, 2}, {NormalRule::surface, crushes}, 0.0, expected);
    REQUIRE_FALSE(found.empty());
    CHECK(found.size() == expected.size());
    CHECK(deepest(found) == Near(-depth).epsilon(1e-6));  // normals of creases are floats
    for (const Contact& c : found) {
        CHECK(c.normal.dot(Vec3::Unit(axis)) > 0.999);
        CHECK(c.is_of_solids());
        CHECK(std::isfinite(c.section) == crushes);
    }
}

TEST_CASE("deep pairs part, step by step, whether their ice can be crushed or not",
          "[narrow][analytic]") {
    const double pressure = GENERATE(kAll, 1e6);
    World w = two_boxes(Vec3(8, 4, 1), 0.25, 0.7, Vec3(0.3, 0.2, 0.35));  // 0.65 m deep
    w.parameters.contact.crushing_pressure = pressure;
    for (int k = 0; k < 400; ++k) step(w);
    const Bodies& b = w.scene.bodies;
    const Vec3 apart = b.rotation[1].transpose() * (b.position[2] - b.position[1]);
    if (std::isinf(pressure)) CHECK(apart.z() > 1.0 - 0.01);
    // crushed or separated, nothing is left that the finder would still have to push out
    std::vector<Contact> contacts;
    ContactFinder().find(w.scene, {{1, 2}}, ContactRule(w.parameters), 0.0, 0.0, contacts);
    CHECK(deepest(contacts) > -0.01);
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

TEST_CASE("of more than four corners the ones that stay open in the step are left out",
          "[narrow][analytic]") {
    // One square lies on another in an octagon 4 m broad. It overlaps by 1 mm at one end and is
    // open by 7 mm at the other, where it falls by 8 mm in the step or not at all.
    const double dt = 0.01, slope = 2e-3;
    const bool falls = GENERATE(false, true);
    const Vec3 y = Vec3::UnitY(), z = Vec3::UnitZ();
    World w = two_boxes(Vec3(4, 4, 1), 0.25, 0.7, Vec3(0, 0, 1.0 + 2.0 * slope - 1e-3));
    Bodies& b = w.scene.bodies;
    b.orientation[2] = Eigen::AngleAxisd(-slope, y) * Eigen::AngleAxisd(std::numbers::pi / 4, z);
    b.rotation[2] = b.orientation[2].toRotationMatrix();
    if (falls) b.angular_velocity[2] = 4e-3 / dt * y;
    std::vector<Contact> found;
    ContactFinder().find(w.scene, {{1, 2}}, {NormalRule::surface, false}, dt, 0.01, found);
    REQUIRE(found.size() == 4);
    double left = kAll, right = -kAll;
    for (const Contact& c : found) {
        left = std::min(left, c.point.x());
        right = std::max(right, c.point.x());
    }
    CHECK(left < -1.9);
    CHECK((right > 1.9) == falls);
}

TEST_CASE("the motion of a pair in a step is that of its points", "[narrow][property]") {
    test::Dice dice{std::mt19937(11)};
    const double dt = 0.02, h = 1e-7;
    for (int k = 0; k < 20; ++k) {
        World w = two_boxes(Vec3(4, 4, 1), 0.25, 0.7, Vec3(3, 2, 1));
        Bodies& b = w.scene.bodies;
        b.ship.free = k % 2 == 0;  // its velocity is that of its centre of gravity
        if (b.ship.free) b.ship.centre = 20.0 * dice.vector();
        for (std::size_t i = 0; i < 2; ++i) {
            b.position[i] = 0.5 * dice.vector();
            b.orientation[i] = exponential_map(dice.vector());
            b.rotation[i] = b.orientation[i].toRotationMatrix();
            b.velocity[i] = dice.vector();
            b.angular_velocity[i] = dice.vector();
        }
        const Vec3 point = dice.vector();  // in the ship's axes, and in both boxes' spheres
        const PairView view(w.scene, {0, 1});
        const Vec3 got = PairStep(view, dt).relative().at(point);
        // both bodies a little later, and the place of b's point in the ship's axes then
        Vec3 position[2];
        Mat3 rotation[2];
        for (std::size_t i = 0; i < 2; ++i) {
            const Mat3 turn = exponential_map(h * b.angular_velocity[i]).toRotationMatrix();
            const Vec3 lever = -b.arm(static_cast<std::int32_t>(i), b.position[i]);
            position[i] = b.position[i] + lever + h * b.velocity[i] - turn * lever;
            rotation[i] = turn * b.rotation[i];
        }
        const Vec3 of_b = view.to_b(point);
        const Vec3 later =
            rotation[0].transpose() * (rotation[1] * of_b + position[1] - position[0]);
        CHECK((got - dt / h * (later - point)).norm() < tolerance(1e-5));
        CHECK(got.norm() <= dt * closing_speed(w.scene, {0, 1}));
    }
}

TEST_CASE("in rigid ice a convex hull meets convex floes as solids, and its spheres have the loads",
          "[narrow][analytic]") {
    World w = test::plate_world(test::empty_space(0.01), Vec3(4, 2, 1), 0.25, 0.5, -0.5);
    const auto row = test::add_shape(w, test::make_box_set(Vec3(8, 1.5, 1), 0.25, 0.7));
    // its side reaches 0.03 m into the hull's, and beyond both ends of it
    add_floe(w.scene, row, 900.0, Vec3(0.0, 1.75 - 0.03, 0.25), Quaternion::Identity(), 0, false);
    std::vector<Contact> found, crushed;
    ContactFinder().find(w.scene, {{0, 1}}, {NormalRule::surface, false}, 0.0, 0.0, found);
    ContactFinder().find(w.scene, {{0, 1}}, {NormalRule::surface, true}, 0.0, 0.0, crushed);
    REQUIRE(found.size() == 4);
    CHECK(crushed.size() > 4);  // these are spheres
    const Shape& hull = w.scene.shape_of(0);
    for (const Contact& c : found) {
        CHECK(c.gap == Near(-0.03).epsilon(1e-9));
        CHECK((c.normal - Vec3::UnitY()).norm() < tolerance(1e-9));
        CHECK(std::abs(c.point.x()) == Near(2.0).margin(1e-3));
        CHECK(c.sphere_a == nearest_sphere(hull, c.point));
        CHECK(c.region == hull.region.at(c.sphere_a, c.normal));
        CHECK(std::isinf(c.section));
    }
}

TEST_CASE("the nearest sphere is that, and of equals the one that mirror images have in common",
          "[narrow]") {
    const Shape shape = build_shape(test::make_box_set(Vec3(2, 1, 0.5), 0.125, 0.25), true);
    for (std::size_t k = 0; k < shape.center.size(); ++k)
        CHECK(nearest_sphere(shape, shape.center[k]) == static_cast<std::int32_t>(k));
    // several clusters of spheres, points inside and outside
    const Shape large = build_shape(test::make_box_set(Vec3(8, 4, 1), 0.125, 0.25), true);
    REQUIRE(large.center.size() > 1000);
    test::Dice dice{std::mt19937(5)};
    for (int k = 0; k < 500; ++k) {
        const Vec3 at = dice.vector().cwiseProduct(Vec3(6, 3, 1));
        auto least = std::tuple(kAll, std::int32_t{0}, std::int32_t{0});
        for (std::size_t row = 0; row < large.center.size(); ++row)
            least =
                std::min(least, std::tuple((large.center[row] - at).squaredNorm(),
                                           large.mirror_rank[row], static_cast<std::int32_t>(row)));
        REQUIRE(nearest_sphere(large, at) == std::get<2>(least));
    }
    const auto port = nearest_sphere(shape, Vec3(0.9, 0.4, 0.01)),
               starboard = nearest_sphere(shape, Vec3(0.9, -0.4, 0.01));
    CHECK(shape.mirror_rank[static_cast<std::size_t>(port)] ==
          shape.mirror_rank[static_cast<std::size_t>(starboard)]);
}
