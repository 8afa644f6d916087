// SPDX-License-Identifier: GPL-3.0-or-later
// How long lists of spheres are good under the rule "centres".
#include <catch2/catch.hpp>

#include "solver/broad/motion_bounds.hpp"
#include "solver/narrow/find_contacts.hpp"
#include "tests/support/make_worlds.hpp"

using namespace ice;

TEST_CASE("a ball that passes one sphere comes upon the next, which was out of range when listed",
          "[narrow][equivalence]") {
    constexpr double r = 0.1, margin = 0.002, go = 0.01;
    // the ball keeps 0.03 m from the first sphere, 2 r beside it, and heads for the second; that
    // one's gap is a little more than what is listed, margin + 0.6 r
    SphereSet two = test::make_ball_set(r);
    two.mesh = test::make_box_mesh(Vec3(4, 4, 4));
    two.surface_count = 2;
    two.centers = {Vec3::Zero(), Vec3(2.0 * r + margin + 0.6 * r + 0.0005, 2.0 * r + 0.03, 0.0)};
    two.radii.push_back(r);
    for (auto* values : {&two.volumes, &two.areas}) values->push_back(values->front());
    two.normals.push_back(two.normals.front());
    two.normal_spread.push_back(two.normal_spread.front());
    two.regions.push_back(0);

    Case p = test::empty_space(0.01);
    p.normal = NormalRule::centres;
    World w = test::plate_world(p, Vec3(1, 1, 1), 0.1, 0.2, 100.0);
    const std::int32_t pair = test::add_shape(w, two);
    const std::int32_t ball = test::add_shape(w, test::make_ball_set(r));
    const std::size_t still =
        add_floe(w.scene, pair, 900.0, Vec3::Zero(), Quaternion::Identity(), 0, false);
    const std::size_t moving = add_floe(w.scene, ball, 900.0, Vec3(0.0, 2.0 * r + 0.03, 0.0),
                                        Quaternion::Identity(), 0, false);
    Bodies& b = w.scene.bodies;
    b.velocity[moving] = Vec3(go / p.time_step, 0, 0);
    const std::vector<BodyPair> pairs{
        {static_cast<std::int32_t>(still), static_cast<std::int32_t>(moving)}};

    MotionBounds motion;
    ContactFinder kept;
    std::vector<Contact> found;
    std::size_t met = 0;
    for (int k = 0; k < 7; ++k) {
        motion.update(w.scene, p.time_step);
        kept.find(w.scene, pairs, motion, p.normal, p.time_step, margin, found);
        std::vector<Contact> expected;
        reference::find_contacts(w.scene, pairs[0], p.normal, go + margin, expected);
        REQUIRE(found.size() == expected.size());
        met += found.size();
        b.position[moving].x() += go;
    }
    CHECK(met > 0);
}
