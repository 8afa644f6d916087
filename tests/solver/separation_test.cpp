// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies apart, and bodies whose edges cross each other.
//
// Tolerances: 1e-12 m is rounding of a few dozen products of lengths of a metre.
#include "solver/narrow/feature/separation.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "solver/broad/motion_bounds.hpp"
#include "solver/narrow/find_contacts.hpp"
#include "tests/support/make_worlds.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using namespace ice::test;

namespace {

const Vec3 kSize(1.0, 0.8, 0.3);  // [m]

// Two boxes, bodies 1 and 2, far below a hull.
World two_boxes() {
    World w = plate_world(empty_space(0.01), Vec3(4, 2, 1), 0.1, 0.2, 10.0);
    const auto row = add_shape(w, make_box_set(kSize, 0.05, 0.1));
    for (int k = 0; k < 2; ++k)
        add_floe(w.scene, row, 900.0, Vec3(5.0 * k, 0, 0), Quaternion::Identity(), 0, false);
    return w;
}

void place(World& w, std::size_t body, const Vec3& position, const Quaternion& orientation) {
    w.scene.bodies.position[body] = position;
    w.scene.bodies.orientation[body] = orientation;
    update_derived(w.scene.bodies, body);
}

double separation_now(const World& w) { return separation(PairView(w.scene, {1, 2})); }

struct Dice {
    std::mt19937 engine;
    double operator()() { return std::uniform_real_distribution<double>(-1.0, 1.0)(engine); }
    Vec3 vector() { return Vec3((*this)(), (*this)(), (*this)()); }
    Quaternion turn(double angle) {
        return Quaternion(Eigen::AngleAxisd(angle * (*this)(), vector().normalized()));
    }
};

// Least distance of points on the second box, 5 cm apart, from the first one.
double distance_of_points(const World& w) {
    const PairView view(w.scene, {1, 2});
    double least = std::numeric_limits<double>::infinity();
    for (double x = -0.5; x < 0.51; x += 0.05)
        for (double y = -0.4; y < 0.41; y += 0.05)
            for (double z = -0.15; z < 0.16; z += 0.05) {
                const Vec3 at = view.rotation_ab * Vec3(x, y, z) + view.translation_ab;
                const Vec3 beyond = (at.cwiseAbs() - 0.5 * kSize).cwiseMax(0.0);
                least = std::min(least, beyond.norm());
            }
    return least;
}

}  // namespace

TEST_CASE("boxes face to face, edge to face and corner to face are apart by the gap",
          "[narrow][analytic]") {
    World w = two_boxes();
    const double gap = GENERATE(0.2, 0.003, 0.0, -0.01);
    const double heading = GENERATE(0.0, 0.3, 0.25 * std::numbers::pi);
    const double tilt = GENERATE(0.0, 0.4);
    const Mat3 turn =
        (Eigen::AngleAxisd(tilt, Vec3::UnitY()) * Eigen::AngleAxisd(heading, Vec3::UnitZ()))
            .toRotationMatrix();
    const double half = turn.row(0).cwiseAbs().dot(0.5 * kSize);  // the box's extent along x
    place(w, 2, Vec3(0.5 + gap + half, 0.01, 0.02), Quaternion(turn));
    // lengths of a metre
    CHECK(separation_now(w) == Near(gap).margin(1e-15));
}

TEST_CASE("no body is nearer than its separation says, wherever it is", "[narrow][property]") {
    World w = two_boxes();
    Dice dice{std::mt19937(4)};
    int apart = 0;
    for (int k = 0; k < 300; ++k) {
        place(w, 1, Vec3::Zero(), Quaternion::Identity());
        place(w, 2, 1.2 * dice.vector(), dice.turn(3.0));
        const double separated = separation_now(w);
        apart += separated > 0.0;
        REQUIRE(distance_of_points(w) >= separated - tolerance(1e-12));
    }
    CHECK(apart > 50);
}

TEST_CASE("a separation shrinks by no more than its share of the moved that bodies go",
          "[narrow][property]") {
    World w = two_boxes();
    Dice dice{std::mt19937(5)};
    for (int k = 0; k < 300; ++k) {
        place(w, 1, 0.1 * dice.vector(), dice.turn(3.0));
        place(w, 2, 1.5 * dice.vector().normalized(), dice.turn(3.0));
        const double before = separation_now(w);
        const double share = separation_share(PairView(w.scene, {1, 2}));
        double moved = 0.0;
        for (const std::size_t body : {1u, 2u}) {
            const Vec3 go = 0.05 * dice.vector();
            const double angle = 0.05 * dice();
            const Quaternion turn(Eigen::AngleAxisd(angle, dice.vector().normalized()));
            moved += go.norm() + std::abs(angle) * MotionBounds::lever(w.scene.shapes[1]);
            place(w, body, w.scene.bodies.position[body] + go,
                  turn * w.scene.bodies.orientation[body]);
        }
        REQUIRE(separation_now(w) >= before - share * moved - tolerance(1e-12));
    }
}

TEST_CASE("a gap that is enough is one of the bodies' and is found again along its normal",
          "[narrow][property]") {
    World w = two_boxes();
    Dice dice{std::mt19937(6)};
    int enough_found = 0, axis_kept = 0;
    for (int k = 0; k < 300; ++k) {
        place(w, 2, 1.2 * dice.vector(), dice.turn(3.0));
        const PairView view(w.scene, {1, 2});
        const double enough = 0.2 * dice(), widest = separation(view);
        const auto first = static_cast<std::size_t>(k) % 14;  // of twelve normals
        std::size_t axis = first;
        const double found = separation(view, enough, axis);
        REQUIRE(axis < 12);
        REQUIRE((found > enough) == (widest > enough));
        REQUIRE((found > enough ? found <= widest : found == widest));
        std::size_t again = axis;
        REQUIRE(separation(view, enough, again) == found);
        REQUIRE(again == axis);
        enough_found += found > enough && found < widest;
        axis_kept += axis == first;
    }
    CHECK(enough_found > 10);
    CHECK(axis_kept > 10);
}

TEST_CASE("bounds hold the sharp edges that spheres stand for, where the mesh's are cut off",
          "[narrow][analytic]") {
    // a box's spheres in a frustum: its upper edges are inside the box's by a tenth of their length
    const Vec3 size(1.0, 0.8, 0.4);
    SphereSet set = test::make_box_set(size, 0.05, 0.1);
    for (Vec3& v : set.mesh.vertices)
        if (v.z() > 0.0) v.head<2>() *= 0.9;
    const Shape shape = build_shape(set, false);
    REQUIRE(shape.bounds.known());
    // the side leans by its inset over the height: x + lean (z - bottom) <= x at the bottom; the
    // diagonal (1, 1, 1) of an upper corner's sphere leaves it short of the corner, in each axis by
    // inset / (1 + lean)
    const double inset = 0.05 * size.x(), lean = inset / size.z();
    CHECK(shape.bounds.excess == Near(std::sqrt(3.0) * inset / (1.0 + lean)).epsilon(1e-12));
}

TEST_CASE("spheres in convex bodies are no nearer than the bodies' separation",
          "[narrow][property]") {
    World w = two_boxes();
    const Shape& box = w.scene.shapes[1];
    REQUIRE(box.bounds.enclose_spheres);
    Dice dice{std::mt19937(7)};
    for (int k = 0; k < 100; ++k) {
        place(w, 2, 1.2 * dice.vector(), dice.turn(3.0));
        const PairView view(w.scene, {1, 2});
        double least = std::numeric_limits<double>::infinity();
        for (std::int32_t i = 0; i < std::ssize(box.center); ++i)
            for (std::int32_t j = 0; j < std::ssize(box.center); ++j)
                least = std::min(least, (view.center_b(j) - view.center_a(i)).norm() -
                                            (box.radius[i] + box.radius[j]));
        REQUIRE(least >= separation(view) - tolerance(1e-12));
    }
}

TEST_CASE("a shape with a dent, or whose spheres reach far out of it, encloses no spheres",
          "[narrow][degenerate]") {
    SphereSet set = test::make_box_set(kSize, 0.05, 0.1);
    REQUIRE(build_shape(set, false).bounds.enclose_spheres);
    SphereSet dented = set, small = set;
    dented.mesh.vertices.front() *= 0.2;
    CHECK_FALSE(build_shape(dented, false).bounds.enclose_spheres);
    for (Vec3& v : small.mesh.vertices) v *= 0.8;
    CHECK_FALSE(build_shape(small, false).bounds.enclose_spheres);
}

TEST_CASE("of a shape without bounds nothing is known", "[narrow][degenerate]") {
    World w = two_boxes();
    w.scene.shapes[1].bounds = ConvexBounds();
    CHECK(separation_now(w) == -std::numeric_limits<double>::infinity());
}

TEST_CASE("edges that cross have a contact wherever between their spheres they do",
          "[narrow][edges][analytic]") {
    constexpr double kDepth = 0.004;  // [m]
    World w = two_boxes();
    // the first box's upper edge along y, seen along the mean of its faces' normals, and an upright
    // edge of the second one that crosses it at an angle
    const Vec3 n = Vec3(1, 0, 1).normalized(), edge = Vec3::UnitY();
    const double angle = GENERATE(0.3, 0.8, 0.5) * std::numbers::pi;
    const Vec3 line = std::cos(angle) * edge + std::sin(angle) * edge.cross(n);
    const Vec3 across = line.cross(n);
    Mat3 turn;
    turn.col(0) = (-n - across).normalized();  // of the faces x and y that meet in its edge
    turn.col(1) = (-n + across).normalized();
    turn.col(2) = turn.col(0).cross(turn.col(1));
    std::vector<Contact> contacts;
    for (double along = -0.38; along < 0.385; along += 0.02)
        for (double height = -0.13; height < 0.135; height += 0.02) {
            const Vec3 meet = Vec3(0.5, along, 0.15) - kDepth * n;
            place(w, 2, meet - turn * Vec3(0.5, 0.4, height), Quaternion(turn));
            ContactFinder().find(w.scene, {{1, 2}}, NormalRule::surface, 0.0, 0.0, contacts);
            CAPTURE(angle, along, height);
            REQUIRE_FALSE(contacts.empty());
            const auto deepest =
                std::min_element(contacts.begin(), contacts.end(),
                                 [](const Contact& l, const Contact& r) { return l.gap < r.gap; });
            CHECK(deepest->gap == Near(-kDepth).margin(1e-9));
            CHECK((deepest->normal - n).norm() < tolerance(1e-6));  // creases' normals are floats
        }
}
