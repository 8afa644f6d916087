// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies that are not both convex, however deep they lie in each other.
//
// Tolerances: 1e-9 is rounding of a normal or a depth, with a reserve; 1e-6 m is a normal stored as
// a float.
#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "solver/narrow/feature/deep_pair.hpp"
#include "solver/narrow/feature/separating_axis.hpp"
#include "solver/narrow/find_contacts.hpp"
#include "solver/narrow/manifold/find_polygon.hpp"
#include "solver/record/solid_overlap.hpp"
#include "tests/support/make_angle_world.hpp"
#include "tests/support/make_filled_sets.hpp"
#include "tests/support/make_prisms.hpp"
#include "tests/support/make_worlds.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;
using ice::test::tolerance;

namespace {

constexpr double kRadius = 0.05;
constexpr double kSlack = 0.1 * kRadius;  // of deep_seats.hpp

// The angle and the box in ice that crushes.
World angle_and_box(const Vec3& place, const Quaternion& turn = Quaternion::Identity()) {
    World w = test::angle_and_box(kRadius, place, turn);
    w.parameters.contact.crushing_pressure = 1e6;
    return w;
}

std::vector<Contact> contacts_of(const World& w) {
    std::vector<Contact> out;
    ContactFinder().find(w.scene, {{0, 1}}, ContactRule(w.parameters), w.parameters.time_step, 5e-4,
                         out);
    return out;
}

// A hull of flat faces, 4 x 2 x 1 m, with a pointed bow and sloping sides, as a ship and a box of
// 1.2 x 1 x 0.4 m as a floe, in ice that does not crush.
World wedge_and_box(const Vec3& place, const Quaternion& turn) {
    std::vector<Vec3> low, high;
    for (const auto& [x, y] :
         {std::pair(-2.0, -1.0), {1.0, -1.0}, {2.0, 0.0}, {1.0, 1.0}, {-2.0, 1.0}}) {
        low.emplace_back(0.6 * x, 0.6 * y, -0.5);
        high.emplace_back(x, y, 0.5);
    }
    World w;
    w.parameters = test::empty_space(0.01);
    const TriangleMesh mesh = test::make_ring_mesh(low, high);
    w.scene = make_scene(build_shape(test::fill_surface(mesh, kRadius, 0.1), false), Vec3::Zero(),
                         Vec3::Zero());
    const auto box = test::add_shape(w, test::fill_box(Vec3(1.2, 1, 0.4), kRadius, 0.1));
    add_floe(w.scene, box, 900.0, place, turn, 0, false);
    return w;
}

// Of a point in body axes [m]; negative outside.
double depth_in(const Shape& shape, const Vec3& p) {
    const Foot foot = shape.surface->closest(p);
    return foot.inside ? foot.distance : -foot.distance;
}

}  // namespace

TEST_CASE("convex solids have a contact as deep as their separating axis says, in any pose",
          "[narrow][deep]") {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> even(-1.0, 1.0);
    int shallow = 0, deep = 0;
    World w = wedge_and_box(Vec3::Zero(), Quaternion::Identity());
    REQUIRE(is_convex_pair(PairView(w.scene, {0, 1})));
    for (int k = 0; k < 4000; ++k) {
        w.scene.bodies.rotation[1] =
            Quaternion(even(random), even(random), even(random), even(random)).normalized();
        w.scene.bodies.position[1] = Vec3(2.6 * even(random), 1.6 * even(random), even(random));
        const PairView view(w.scene, {0, 1});
        const double depth = -find_axes(view.shape_a.convex, view.shape_b.convex,
                                        {view.rotation_ab, view.translation_ab}, 0.0)
                                  .widest();
        if (depth <= 0.0) continue;
        double least = 0.0;
        for (const Contact& c : contacts_of(w)) least = std::min(least, c.gap);
        CAPTURE(k, depth, least);
        // the slack of find_polygon.hpp; 1e-9 m is rounding
        CHECK(-least >= depth - 0.02 * kRadius - tolerance(1e-9));
        ++(depth < kRadius ? shallow : deep);
    }
    // otherwise the poses show nothing
    CHECK(shallow > 100);
    CHECK(deep > 100);
}

TEST_CASE("a floe in a hull that is not convex is felt at every depth, along the hull's normal",
          "[narrow][deep][analytic]") {
    // the box comes along -x over the face x = 2 of the angle's leg of 2 m
    const double depth = GENERATE(0.01, 0.06, 0.2, 0.5, 0.9);
    const World w = angle_and_box(Vec3(2.0 + 0.6 - depth, -1.0, 0.0));
    const std::vector<Contact> contacts = contacts_of(w);
    REQUIRE(!contacts.empty());
    double least = 0.0;
    for (const Contact& c : contacts) {
        least = std::min(least, c.gap);
        if (depth < 0.3 && c.key >> 62 == 3)
            CHECK((c.normal - Vec3::UnitX()).norm() < tolerance(1e-9));
    }
    CAPTURE(depth, contacts.size());
    // seats on the box's face are as deep as the face, or as half of the leg's height, 0.5 m, from
    // which on the leg's upper and lower faces are nearer; they are up to 0.1 m from that middle
    CHECK(least >= -std::min(depth, 0.5) - tolerance(1e-6));
    CHECK(least <= -std::min(depth, 0.4) + tolerance(1e-6));
    // the finder and the look at the solids agree
    const OverlapFound found = measure_overlaps(w.scene, contacts);
    CHECK(found.deepest <= -least + kSlack);
    for (const UnseenOverlap& pair : found.unseen) CHECK(pair.depth <= kSlack);
}

TEST_CASE("deep contacts of a solid that is not convex lie in both solids, and none is missing",
          "[narrow][deep]") {
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> even(-1.0, 1.0);
    World w = angle_and_box(Vec3::Zero());
    int deep = 0;
    for (int k = 0; k < 2000; ++k) {
        w.scene.bodies.rotation[1] =
            Quaternion(even(random), even(random), even(random), even(random)).normalized();
        w.scene.bodies.position[1] = Vec3(2.8 * even(random), 2.8 * even(random), even(random));
        const PairView view(w.scene, {0, 1});
        const std::vector<Contact> contacts = contacts_of(w);
        const auto in_hull = [&](const Vec3& p) { return depth_in(view.shape_a, p); };
        const auto in_floe = [&](const Vec3& p) { return depth_in(view.shape_b, view.to_b(p)); };
        double least = 0.0;
        for (const Contact& c : contacts) {
            least = std::min(least, c.gap);
            if (c.gap >= -kSlack) continue;
            // the point is half way between the two surfaces: of a face and a point of the other
            // body the latter is as deep, two edges that cross have it inside both; 1e-9 m is
            // rounding
            const Vec3 half = 0.5 * c.gap * c.normal;
            const bool on_face = in_hull(c.point + half) >= -c.gap - 1e-9 ||
                                 in_floe(c.point - half) >= -c.gap - 1e-9;
            CAPTURE(k, c.gap, c.sphere_a, c.sphere_b);
            CHECK((on_face || (in_hull(c.point) > 0.0 && in_floe(c.point) > 0.0)));
            ++deep;
        }
        double deepest = 0.0;
        const auto seat = [](const Shape& s, std::size_t n) {
            return Vec3(s.center[n] + s.radius[n] * s.normal[n]);
        };
        for (std::size_t n = 0; n < view.shape_a.center.size(); ++n)
            deepest = std::max(deepest, in_floe(seat(view.shape_a, n)));
        for (std::size_t n = 0; n < view.shape_b.center.size(); ++n)
            deepest = std::max(
                deepest, in_hull(view.rotation_ab * seat(view.shape_b, n) + view.translation_ab));
        CAPTURE(k, least, deepest);
        CHECK(-least >= deepest - kSlack - tolerance(1e-9));
    }
    CHECK(deep > 1000);  // otherwise the poses show nothing
}

TEST_CASE("nothing is felt in the angle's notch, and contacts within a slack are the spheres'",
          "[narrow][deep]") {
    CHECK(contacts_of(angle_and_box(Vec3(0.62, 0.72, 0.0))).empty());
    const World w = angle_and_box(Vec3(0.6 - 0.02, 0.72, 0.0));
    for (const Contact& c : contacts_of(w)) {
        CHECK(c.key >> 62 == 0);
        CHECK((c.normal - Vec3::UnitX()).norm() < tolerance(1e-9));
        CHECK(c.gap == Near(-0.02).margin(1e-9));
    }
}

TEST_CASE("deep seats found in steps are those found afresh, to the last bit",
          "[narrow][deep][property]") {
    // a floe that is pulled through the hull and turns, whatever pushes it out
    World w = angle_and_box(Vec3(2.7, -1.0, 0.1),
                            Quaternion(Eigen::AngleAxisd(0.3, Vec3(0.3, 0.5, 0.8).normalized())));
    MotionBounds motion;
    ContactFinder kept;
    std::vector<Contact> found;
    std::size_t deep = 0;
    for (int k = 0; k < 400; ++k) {
        Bodies& b = w.scene.bodies;
        b.velocity[1] = Vec3(-1.2, 0.3, -0.1);
        b.angular_velocity[1] = Vec3(0.2, 0.1, -0.4);
        motion.update(w.scene, w.parameters.time_step);
        kept.find(w.scene, {{0, 1}}, motion, ContactRule(w.parameters), w.parameters.time_step,
                  5e-4, found);
        const std::vector<Contact> expected = contacts_of(w);
        REQUIRE(found.size() == expected.size());
        for (std::size_t c = 0; c < found.size(); ++c) {
            REQUIRE(found[c].key == expected[c].key);
            REQUIRE(found[c].gap == expected[c].gap);
            REQUIRE(found[c].point == expected[c].point);
            deep += found[c].key >> 62 == 3 ? 1 : 0;
        }
        b.position[1] += w.parameters.time_step * b.velocity[1];
        const Quaternion turned =
            Quaternion(Eigen::AngleAxisd(w.parameters.time_step * b.angular_velocity[1].norm(),
                                         b.angular_velocity[1].normalized())) *
            b.orientation[1];
        b.orientation[1] = turned.normalized();
        b.rotation[1] = b.orientation[1].toRotationMatrix();
    }
    CHECK(deep > 100);
}
