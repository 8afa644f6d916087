// SPDX-License-Identifier: GPL-3.0-or-later
// Gaps, contacts and pairs.
//
// reference::find_contacts shares measure_gap, check_depths, reduce_manifold and find_deep_seats
// with the finder: it proves the search. The rule has other oracles: tests/poses (volumes, no
// common code), contact_polygon_test.cpp, tests/validation/deep_seats_test.cpp.
//
// Tolerances: 1e-14 and 1e-15 are rounding of a few products of lengths of 0.1 m, 1e-12 that of a
// difference or a root of them; 1e-6 of a gap is a normal stored as a float.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "solver/broad/find_pairs.hpp"
#include "solver/narrow/feature/measure_gap.hpp"
#include "solver/narrow/find_contacts.hpp"
#include "solver/shape/sphere_grid.hpp"
#include "tests/support/make_worlds.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;
using ice::test::tolerance;

namespace {

Feature face(const Vec3& center, double radius, const Vec3& normal) {
    return {center, radius, normal, 1.0, 0.0};
}

Feature edge(const Vec3& center, double radius, const Vec3& normal) {
    return {center, radius, normal, std::sqrt(0.5), std::sqrt(0.5)};
}

bool same(const Contact& l, const Contact& r) {
    return l.a == r.a && l.b == r.b && l.sphere_a == r.sphere_a && l.sphere_b == r.sphere_b &&
           l.key == r.key && l.gap == r.gap && l.normal == r.normal && l.point == r.point &&
           l.patch.share == r.patch.share && l.patch.depth == r.patch.depth && l.region == r.region;
}

}  // namespace

TEST_CASE("two unit spheres 3 m apart leave a gap of 1 m", "[narrow][analytic]") {
    const Gap gap = measure_gap_centres(Vec3::Zero(), 1, Vec3(3, 0, 0), 1);
    CHECK(gap.gap == 1.0);
    CHECK(gap.normal == Vec3::UnitX());
    CHECK(gap.valid);
}

TEST_CASE("coincident centres give no contact", "[narrow][degenerate]") {
    const Feature s = face(Vec3(1, 2, 3), 0.1, Vec3::UnitZ());
    CHECK_FALSE(measure_gap_centres(s.center, 0.1, s.center, 0.1).valid);
    CHECK_FALSE(measure_gap_surface(s, s, true).valid);
}

TEST_CASE("a sphere beside another on a flat face has the face's gap, not the spheres'",
          "[narrow][analytic]") {
    // surface z = 0.1 under which a's face looks up; b is 7 cm aside, its lowest point at z = 0.13
    const Feature a = face(Vec3::Zero(), 0.1, Vec3::UnitZ());
    const Feature b = face(Vec3(0.07, 0, 0.18), 0.05, -Vec3::UnitZ());
    const Gap gap = measure_gap_surface(a, b, true);
    CHECK(gap.gap == Near(0.03).epsilon(1e-14));
    CHECK(gap.normal == Vec3::UnitZ());
    CHECK(gap.reference_offset_sq == Near(0.0049).epsilon(1e-12));
    CHECK(measure_gap_surface(a, b, false).gap == Near(0.03).epsilon(1e-14));
}

TEST_CASE("an edge on a face takes the face's normal, whichever body has it",
          "[narrow][analytic]") {
    const Feature flat = face(Vec3::Zero(), 0.1, Vec3::UnitZ());
    const Feature sharp = edge(Vec3(0.03, 0, 0.14), 0.05, Vec3(1, 0, -1).normalized());
    const Gap forth = measure_gap_surface(flat, sharp, false);
    const Gap back = measure_gap_surface(sharp, flat, false);
    CHECK(forth.normal == Vec3::UnitZ());
    CHECK(forth.reference_is_a);
    CHECK(back.normal == -Vec3::UnitZ());
    CHECK_FALSE(back.reference_is_a);
    CHECK(forth.gap == Near(-0.01).epsilon(1e-12));
    CHECK(back.gap == Near(-0.01).epsilon(1e-12));
}

TEST_CASE("an edge across an edge meets along the line of centres", "[narrow][analytic]") {
    const Feature a = edge(Vec3::Zero(), 0.1, Vec3::UnitX());
    const Feature b = edge(Vec3(0.15, 0.03, 0), 0.05, -Vec3::UnitX());
    const Gap gap = measure_gap_surface(a, b, false);
    CHECK((gap.normal - Vec3(0.15, 0.03, 0).normalized()).norm() < tolerance(1e-15));
}

TEST_CASE("faces turned away from each other do not touch", "[narrow]") {
    const Feature a = face(Vec3::Zero(), 0.1, -Vec3::UnitZ());
    CHECK_FALSE(measure_gap_surface(a, face(Vec3(0, 0, 0.1), 0.05, Vec3::UnitZ()), false).valid);
}

TEST_CASE("a floe face under a flat hull has one contact per floe sphere, all with the same gap",
          "[narrow][analytic]") {
    World w = test::plate_world(test::empty_space(0.01), Vec3(6, 4, 0.4), 0.1,
                                GENERATE(0.05, 0.1, 0.2), 0.0);
    const auto box = test::add_shape(w, test::make_box_set(Vec3(1, 0.8, 0.3), 0.05, 0.1));
    add_floe(w.scene, box, 900.0, Vec3(0.03, 0.04, -0.152), Quaternion::Identity(), 0, false);
    std::vector<Contact> contacts;
    reference::find_contacts(w.scene, {0, 1}, NormalRule::surface, 0.01, contacts);
    CHECK(contacts.size() == 80);  // 10 x 8 spheres of the floe's upper face
    double area = 0.0;
    for (const Contact& c : contacts) {
        // normals are floats: an edge's corner is a part in 1e7 off its sphere
        REQUIRE(c.gap == Near(0.002).epsilon(1e-6));
        REQUIRE((c.normal + Vec3::UnitZ()).norm() < tolerance(1e-12));
        area += cut_area(c.patch, c.patch.depth);
    }
    // shares of the make_box_set are 0.01 m2 per face and sphere; normals are floats, so a flat
    // wing of an edge may lean by 1e-7 x its half side of 0.05 m, against a touch of 1e-4 m
    CHECK(area == Near(0.8).epsilon(5e-5));
}

// Moves three of ten spheres of each floe inwards, by up to `most` radii.
void crush_some(Scene& scene, double most) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (const std::int32_t i : scene.bodies.moving) {
        const Shape& shape = scene.shapes[static_cast<std::size_t>(scene.bodies.shape[i])];
        const auto count = static_cast<std::int32_t>(shape.center.size());
        for (std::int32_t k = 0; k < count; ++k)
            if (share(random) < 0.3)
                scene.crushed.crush(i, k, shape.center.size(),
                                    -most * share(random) * shape.radius[k] * shape.normal[k]);
    }
}

TEST_CASE("the grid finds the contacts that testing every sphere with every other finds",
          "[narrow][equivalence]") {
    World w = test::scattered_world(GENERATE(1u, 2u, 3u), 40);
    if (const double most = GENERATE(0.0, 1.0, 3.0); most > 0.0) crush_some(w.scene, most);
    const NormalRule rule = GENERATE(NormalRule::centres, NormalRule::surface);
    std::vector<BodyPair> pairs;
    find_pairs(w.scene, 0.01, pairs);
    ContactFinder finder;
    std::vector<Contact> found, expected;
    finder.find(w.scene, pairs, rule, 0.0, 0.002, found);
    for (const BodyPair& pair : pairs)
        reference::find_contacts(w.scene, pair, rule, 0.002, expected);
    REQUIRE(expected.size() > 100);
    REQUIRE(found.size() == expected.size());
    for (std::size_t k = 0; k < found.size(); ++k) REQUIRE(same(found[k], expected[k]));
}

TEST_CASE("pairs that are not looked at have no contacts, step after step",
          "[narrow][equivalence][long]") {
    const double size = GENERATE(1.0, 10.0);  // spheres of half a metre reach farther
    World w = test::scattered_world(GENERATE(1u, 2u), 60, size);
    w.parameters.normal = GENERATE(NormalRule::centres, NormalRule::surface);
    w.parameters.contact.crushing_pressure = GENERATE(std::numeric_limits<double>::infinity(), 1e4);
    Bodies& b = w.scene.bodies;
    for (const std::int32_t i : b.moving) {  // towards the middle, turning
        b.velocity[i] = -0.5 / size * b.position[i];
        b.angular_velocity[i] = 0.5 * b.position[i].normalized();
        const Mat3& r = b.rotation[i];
        b.angular_momentum[i] = r * (b.inertia(i) * (r.transpose() * b.angular_velocity[i]));
    }
    const NormalRule rule = w.parameters.normal;
    const double dt = w.parameters.time_step;
    MotionBounds travel;
    PairList list;
    ContactFinder kept;
    std::vector<Contact> found, expected;
    std::size_t compared = 0;
    for (int k = 0; k < 40; ++k) {
        travel.update(w.scene, dt);
        list.update(w.scene, travel, 0.002);
        kept.find(w.scene, list.pairs(), travel, rule, dt, 0.002, found);
        std::vector<BodyPair> pairs;
        find_pairs(w.scene, 1.0, pairs);
        ContactFinder().find(w.scene, pairs, rule, dt, 0.002, expected);
        REQUIRE(found.size() == expected.size());
        for (std::size_t c = 0; c < found.size(); ++c) REQUIRE(same(found[c], expected[c]));
        compared += found.size();
        step(w);
    }
    CHECK(compared > 1000);
    CHECK(std::isinf(w.parameters.contact.crushing_pressure) ==
          w.scene.crushed.displacement.empty());
}

TEST_CASE("a grid query finds every point in range", "[shape][property]") {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    std::vector<Vec3> points;
    for (int k = 0; k < 500; ++k) points.emplace_back(3 * unit(random), unit(random), unit(random));
    const SphereGrid grid(points, GENERATE(0.05, 0.3, 10.0));
    for (int k = 0; k < 50; ++k) {
        const Vec3 at(4 * unit(random), 2 * unit(random), 2 * unit(random));
        const double range = 0.4;
        const auto is_near = [&](std::int32_t i) {
            return (points[static_cast<std::size_t>(i)] - at).norm() <= range;
        };
        std::vector<std::int32_t> expected, found;
        for (std::int32_t i = 0; i < std::ssize(points); ++i)
            if (is_near(i)) expected.push_back(i);
        grid.for_each_near(at, range, [&](std::int32_t i) {
            if (is_near(i)) found.push_back(i);
        });
        std::sort(found.begin(), found.end());
        REQUIRE(found == expected);
    }
    SphereGrid({}, 1.0).for_each_near(Vec3::Zero(), 10.0, [](std::int32_t) { FAIL(); });
}

TEST_CASE("mirror-image poses give mirror-image contacts in the same order, bit for bit",
          "[narrow][property]") {
    // sizes that binary numbers hold exactly, so that the sets are exactly symmetric
    const NormalRule rule = GENERATE(NormalRule::surface, NormalRule::centres);
    std::mt19937 random(GENERATE(1u, 2u, 3u, 4u, 5u));
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    World port = test::plate_world(test::empty_space(0.01), Vec3(4, 2, 0.5), 0.125, 0.25, -0.25);
    const auto box = test::add_shape(port, test::make_box_set(Vec3(1, 0.75, 0.25), 0.0625, 0.125));
    World starboard = port;
    for (int k = 0; k < 2; ++k) {
        const Vec3 at(0.3 * unit(random), 0.3 * unit(random), -0.4 - 0.15 * k);
        const Quaternion turn(Eigen::AngleAxisd(0.3 * unit(random),
                                                Vec3(unit(random), unit(random), 2).normalized()));
        add_floe(port.scene, box, 900.0, at, turn, 0, false);
        add_floe(starboard.scene, box, 900.0, Vec3(at.x(), -at.y(), at.z()),
                 Quaternion(turn.w(), -turn.x(), turn.y(), -turn.z()), 0, false);
    }
    for (const BodyPair pair : {BodyPair{0, 1}, BodyPair{1, 2}}) {
        std::vector<Contact> left, right;
        reference::find_contacts(port.scene, pair, rule, 0.05, left);
        reference::find_contacts(starboard.scene, pair, rule, 0.05, right);
        CAPTURE(pair.a, pair.b, left.size());
        REQUIRE(left.size() >= 4);  // the poses are not the same with every compiler
        REQUIRE(left.size() == right.size());
        for (std::size_t k = 0; k < left.size(); ++k) {
            const Vec3 flip(1, -1, 1);
            REQUIRE(left[k].gap == right[k].gap);
            REQUIRE(left[k].normal.cwiseProduct(flip) == right[k].normal);
            REQUIRE(left[k].point.cwiseProduct(flip) == right[k].point);
        }
    }
}
