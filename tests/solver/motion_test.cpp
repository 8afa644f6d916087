// SPDX-License-Identifier: GPL-3.0-or-later
// Whole steps against known motions.
//
// Tolerances: 1e-12 is rounding of a hundred equal sums; 1e-6 of p A is an area stored as a float;
// 1e-14 and 1e-15 are rounding of a few products.
#include <catch2/catch.hpp>
#include <cmath>

#include "solver/integrate/integrate.hpp"
#include "solver/integrate/rotation.hpp"
#include "tests/support/make_worlds.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;
using ice::test::tolerance;

TEST_CASE("a ball that hits a plate keeps e^2 of its energy per bounce", "[step][analytic]") {
    const double e = GENERATE(0.0, 0.3, 0.8, 1.0);
    Case p = test::empty_space(0.01);
    p.contact.restitution = e;
    p.contact.friction_ship_ice = 0.1;
    p.normal = GENERATE(NormalRule::centres, NormalRule::surface);
    World w = test::plate_world(p, Vec3(2, 2, 0.4), 0.1, 0.1, 0.0);
    const auto ball = test::add_shape(w, test::make_ball_set(0.05));
    // under the sphere at the plate's middle, so that both rules see the normal -z
    const std::size_t i =
        add_floe(w.scene, ball, 900.0, Vec3(0, 0, -0.2), Quaternion::Identity(), 0, false);
    w.scene.bodies.momentum[i] = w.scene.bodies.mass[i] * Vec3(0, 0, 0.7);
    update_derived(w.scene.bodies, i);
    const double before = kinetic_energy(w.scene.bodies);
    for (int k = 0; k < 60; ++k) step(w);
    // rounding of one impulse
    CHECK(kinetic_energy(w.scene.bodies) == Near(e * e * before).epsilon(1e-12).margin(1e-15));
    CHECK(w.scene.bodies.position[i].z() < -0.05 + tolerance(1e-12));
}

TEST_CASE("a box dropped flat with e = 0.3 leaves with 0.3 of its speed and no spin",
          "[step][analytic]") {
    Case p = test::empty_space(0.01);
    World w = test::plate_world(p, Vec3(4, 4, 0.4), 0.1, 0.1, 0.0);
    const auto box = test::add_shape(w, test::make_box_set(Vec3(1, 0.8, 0.3), 0.05, 0.1));
    const std::size_t i =
        add_floe(w.scene, box, 900.0, Vec3(0.013, 0.021, -0.3), Quaternion::Identity(), 0, false);
    w.scene.bodies.momentum[i] = w.scene.bodies.mass[i] * Vec3(0, 0, 1.0);
    update_derived(w.scene.bodies, i);
    for (int k = 0; k < 40; ++k) step(w);
    // 80 contacts share the impulse; the solver stops at 1e-12 m/s of change per iteration, and
    // the sum of what is left is about a thousand times that
    CHECK(w.scene.bodies.velocity[i].z() == Near(-0.3).epsilon(1e-8));
    CHECK(w.scene.bodies.angular_velocity[i].norm() < tolerance(1e-8));
}

TEST_CASE(
    "a floe pressed by buoyancy under a moving flat plate feels (rho_w - rho_i) g V and mu "
    "times it",
    "[step][analytic]") {
    const double hull_spacing = GENERATE(0.1, 0.2);
    Case p = test::empty_space(0.01);
    p.gravity = 9.81;
    p.buoyancy = GENERATE(BuoyancyModel::centre, BuoyancyModel::distributed);
    p.speed_table = {{0.0, 1.0}};
    p.contact.tolerance = 1e-6;
    p.contact.iterations = 200;
    World w = test::plate_world(p, Vec3(20, 4, 0.4), 0.1, hull_spacing, -1.0);
    const auto box = test::add_shape(w, test::make_box_set(Vec3(1, 0.8, 0.3), 0.05, 0.1));
    add_floe(w.scene, box, 900.0, Vec3(0, 0, -1.15), Quaternion::Identity(), 0, false);
    for (int k = 0; k < 100; ++k) step(w);
    Vec3 normal = Vec3::Zero(), tangent = Vec3::Zero();
    for (int k = 0; k < 100; ++k) {
        step(w);
        const auto [n, t] = test::ship_on_ice(w);
        normal += n / 100.0;
        tangent += t / 100.0;
    }
    const double expected = (1000.0 - 900.0) * 9.81 * 0.24;  // 235.44 N
    CHECK(-normal.z() == Near(expected).epsilon(0.005));
    CHECK(normal.x() == Near(0.0).margin(1e-6));  // flat whatever the spheres' spacing
    CHECK(tangent.x() == Near(0.1 * expected).epsilon(0.01));
}

TEST_CASE(
    "torque-free rotation keeps L to 1e-13 and energy to 1e-6 over 10000 steps at "
    "|w| dt = 0.05",
    "[integrate][analytic]") {
    Case p = test::empty_space(0.01);
    World w = test::plate_world(p, Vec3(1, 1, 1), 0.1, 0.2, 100.0);
    const auto box = test::add_shape(w, test::make_box_set(Vec3(1, 0.8, 0.3), 0.05, 0.1));
    const std::size_t i =
        add_floe(w.scene, box, 900.0, Vec3::Zero(), Quaternion::Identity(), 0, false);
    Bodies& b = w.scene.bodies;
    // near the unstable middle axis: the worst case for an integrator
    const Vec3 spin = 5.0 * Vec3(0.1, 1.0, 0.1).normalized();
    b.angular_momentum[i] = b.inertia(i) * spin;
    update_derived(b, i);
    const Vec3 momentum = b.angular_momentum[i];
    const double energy = kinetic_energy(b);
    double worst = 0.0;
    for (int k = 0; k < 10000; ++k) {
        step(w);
        worst = std::max(worst, std::abs(kinetic_energy(b) / energy - 1.0));
    }
    CHECK((b.angular_momentum[i] - momentum).norm() <= tolerance(1e-13) * momentum.norm());
    CHECK(worst <= tolerance(1e-6));
}

TEST_CASE("the exponential map equals sine and cosine", "[integrate][analytic]") {
    const Vec3 axis = Vec3(1, -2, 0.5).normalized();
    const double angle = GENERATE(0.0, 1e-9, 0.01, 0.9, 1.1, 3.0, 6.0);
    const Quaternion q = exponential_map(angle * axis);
    const Quaternion expected(Eigen::AngleAxisd(angle, axis));
    CHECK((q.coeffs() - expected.coeffs()).norm() < tolerance(1e-15) * 8);  // a few roundings
}

TEST_CASE("a free fall without water gains g t", "[step][analytic]") {
    Case p = test::empty_space(0.01);
    p.gravity = 9.81;
    World w = test::plate_world(p, Vec3(1, 1, 1), 0.1, 0.2, 100.0);
    const auto box = test::add_shape(w, test::make_box_set(Vec3(1, 0.8, 0.3), 0.05, 0.1));
    const std::size_t i =
        add_floe(w.scene, box, 900.0, Vec3::Zero(), Quaternion::Identity(), 0, false);
    for (int k = 0; k < 100; ++k) step(w);
    CHECK(w.scene.bodies.velocity[i].z() == Near(-9.81).epsilon(1e-12));
}

TEST_CASE("collisions never add energy: head-on, offset with spin, against a plate",
          "[step][property]") {
    Case p = test::empty_space(0.01);
    p.normal = GENERATE(NormalRule::centres, NormalRule::surface);
    const double offset = GENERATE(0.0, 0.3, 0.6);
    World w = test::plate_world(p, Vec3(8, 4, 0.4), 0.1, 0.2, 0.6);
    const auto box = test::add_shape(w, test::make_box_set(Vec3(1, 0.8, 0.3), 0.05, 0.1));
    const std::size_t i = add_floe(w.scene, box, 900.0, Vec3(-1, offset, 0),
                                   Quaternion(Eigen::AngleAxisd(0.3, Vec3::UnitX())), 0, false);
    const std::size_t j =
        add_floe(w.scene, box, 900.0, Vec3(1, 0, 0.05), Quaternion::Identity(), 0, false);
    Bodies& b = w.scene.bodies;
    b.momentum[i] = b.mass[i] * Vec3(1.0, 0, 0.3);
    b.momentum[j] = b.mass[j] * Vec3(-1.0, 0.1, 0.2);
    b.angular_momentum[i] = Vec3(1, 2, 3);
    update_derived(b, i);
    update_derived(b, j);
    double energy = kinetic_energy(b);
    const double start = energy;
    for (int k = 0; k < 300; ++k) {
        step(w);
        const double now = kinetic_energy(b);
        REQUIRE(now <=
                energy + tolerance(1e-6) * start);  // the free rotation's own wobble, see above
        energy = now;
    }
    CHECK(energy < 0.95 * start);  // they did meet
}

TEST_CASE("floes of one shape and density share their moments of inertia, others have their own",
          "[scene]") {
    World w = test::plate_world(test::empty_space(0.01), Vec3(4, 4, 0.4), 0.1, 0.2, 5.0);
    const auto box = test::add_shape(w, test::make_box_set(Vec3(1, 0.8, 0.3), 0.05, 0.1));
    const auto cube = test::add_shape(w, test::make_box_set(Vec3(0.5, 0.5, 0.5), 0.05, 0.1));
    const std::pair<std::int32_t, double> made[] = {{box, 900.0}, {cube, 900.0}, {box, 900.0},
                                                    {box, 800.0}, {cube, 900.0}, {box, 900.0}};
    double x = 0.0;
    for (const auto& [shape, density] : made)
        add_floe(w.scene, shape, density, Vec3(x += 3.0, 0, 0), Quaternion::Identity(), 0, false);
    const Bodies& b = w.scene.bodies;
    CHECK(b.inertia_row[1] == b.inertia_row[3]);
    CHECK(b.inertia_row[2] == b.inertia_row[5]);
    for (std::size_t i = 1; i <= std::size(made); ++i) {
        CAPTURE(i);
        const auto& [shape, density] = made[i - 1];
        const Mat3 expected =
            density * w.scene.shapes[static_cast<std::size_t>(shape)].solid.inertia;
        CHECK(b.inertia(i) == expected);
        // of 3 x 3 numbers, each rounded a few times
        CHECK((b.inverse_inertia(i) * expected - Mat3::Identity()).norm() < tolerance(1e-14));
    }
}

TEST_CASE("loads are those of the floes that move, each its own", "[integrate]") {
    Case p = test::empty_space(0.01);
    p.gravity = 9.81;
    World w = test::plate_world(p, Vec3(4, 4, 0.4), 0.1, 0.2, 5.0);
    const auto box = test::add_shape(w, test::make_box_set(Vec3(1, 0.8, 0.3), 0.05, 0.1));
    for (int k = 0; k < 5; ++k)
        add_floe(w.scene, box, 800.0 + 10.0 * k, Vec3(3.0 * k, 0, 0), Quaternion::Identity(), 0,
                 k % 2 == 1);
    std::vector<FloeLoad> loads;
    measure_loads(w.scene, p, loads);
    CHECK(loads.size() == 3);
    const std::vector<FloeLoad> all = loads_by_body(w.scene.bodies, loads);
    REQUIRE(all.size() == 6);
    for (std::size_t i = 0; i < all.size(); ++i) {
        CAPTURE(i);
        const bool moves = i % 2 == 1;
        CHECK(all[i].force.z() == (moves ? -w.scene.bodies.mass[i] * p.gravity : 0.0));
    }
}

TEST_CASE("a held floe stays until the ship touches it, and 'always' stays for good",
          "[step][hold]") {
    const Hold hold = GENERATE(Hold::until_hull_contact, Hold::always);
    Case p = test::empty_space(0.01);
    p.floes[0].hold = hold;
    p.speed_table = {{0.0, 1.0}};
    World w = test::plate_world(p, Vec3(1, 1, 1), 0.1, 0.1, -0.5);
    const auto box = test::add_shape(w, test::make_box_set(Vec3(1, 0.8, 0.3), 0.05, 0.1));
    const std::size_t i =
        add_floe(w.scene, box, 900.0, Vec3(1.5, 0, 0), Quaternion::Identity(), 0, true);
    for (int k = 0; k < 45; ++k) step(w);  // ship's front at 0.95, floe's edge at 1.0
    CHECK(w.scene.bodies.held[i] == 1);
    CHECK(w.scene.bodies.position[i] == Vec3(1.5, 0, 0));
    for (int k = 0; k < 20; ++k) step(w);
    CHECK(w.scene.bodies.held[i] == (hold == Hold::always ? 1 : 0));
    CHECK((w.scene.bodies.position[i].x() > 1.5) == (hold != Hold::always));
}

TEST_CASE("until-contact: a moving floe releases the next in a row, until-hull-contact does not",
          "[step][hold]") {
    const Hold hold = GENERATE(Hold::until_contact, Hold::until_hull_contact);
    Case p = test::empty_space(0.01);
    p.floes.resize(2);
    p.floes[0].hold = Hold::never;
    p.floes[1].hold = hold;
    World w = test::plate_world(p, Vec3(1, 1, 1), 0.1, 0.2, 50.0);
    const auto box = test::add_shape(w, test::make_box_set(Vec3(1, 0.8, 0.3), 0.05, 0.1));
    const std::size_t first =
        add_floe(w.scene, box, 900.0, Vec3(0, 0, 0), Quaternion::Identity(), 0, false);
    const std::size_t next =
        add_floe(w.scene, box, 900.0, Vec3(1.1, 0, 0), Quaternion::Identity(), 1, true);
    Bodies& b = w.scene.bodies;
    b.momentum[first] = b.mass[first] * Vec3(1, 0, 0);
    update_derived(b, first);
    for (int k = 0; k < 30; ++k) step(w);
    CHECK(b.held[next] == (hold == Hold::until_contact ? 0 : 1));
    if (hold == Hold::until_contact) {
        // two equal masses, e = 0.3: (1 - e) / 2 and (1 + e) / 2 of the speed
        CHECK(b.velocity[first].x() == Near(0.35).epsilon(1e-6));
        CHECK(b.velocity[next].x() == Near(0.65).epsilon(1e-6));
    } else {
        // as from a wall; 24 contacts share it, and 1000 iterations leave 3e-5 of it
        CHECK(b.velocity[first].x() == Near(-0.3).epsilon(1e-4));
    }
}

TEST_CASE("a crushed patch carries pressure x area, whatever the spheres", "[step][analytic]") {
    // a floe driven against a plate: p A with A the face's share of the contacts
    const double spacing = GENERATE(0.05, 0.1);
    Case p = test::empty_space(0.01);
    p.contact.crushing_pressure =
        1e3;  // 1 kPa on about 0.8 m2: far less than what would stop the floe
    p.contact.friction_ship_ice = 0.0;
    World w = test::plate_world(p, Vec3(4, 4, 0.4), 0.1, 0.1, 0.0);
    const SphereSet set = test::make_box_set(Vec3(1, 0.8, 0.3), 0.05, spacing);
    const auto box = test::add_shape(w, set);
    const std::size_t i =
        add_floe(w.scene, box, 900.0, Vec3(0.01, 0.02, -0.1501), Quaternion::Identity(), 0, false);
    w.scene.bodies.momentum[i] = w.scene.bodies.mass[i] * Vec3(0, 0, 1.0);
    update_derived(w.scene.bodies, i);
    step(w);
    // the test set gives every sphere on the upper face a cell of spacing^2 there
    double area = 0.0;
    for (std::size_t k = 0; k < set.surface_count; ++k)
        if (set.normals[k].z() > 0.3) area += spacing * spacing;
    CHECK(-test::ship_on_ice(w).first.z() == Near(1e3 * area).epsilon(1e-6));
}

TEST_CASE("2D: a prism that hits a plate off its centre turns as plane mechanics says",
          "[step][2d][analytic]") {
    Case p = test::empty_space(0.001);
    p.dimension = 2;
    p.contact.restitution = 0.3;
    p.contact.friction_ship_ice = 0.0;
    World w;
    w.parameters = p;
    w.scene = make_scene(build_shape(test::make_box_set(Vec3(4, 1, 0.4), 0.1, 0.05, 2), false),
                         Vec3(0, 0, 0.2), Vec3::Zero());
    const auto box = test::add_shape(w, test::make_box_set(Vec3(1, 1, 0.4), 0.1, 0.05, 2));
    // turned by 0.3 rad about y: the corner at (-0.5, 0, 0.2) of its axes is the highest
    const double turn = 0.3, cosine = std::cos(turn), sine = std::sin(turn);
    const Vec3 corner(-0.5 * cosine + 0.2 * sine, 0, 0.5 * sine + 0.2 * cosine);
    const std::size_t i = add_floe(w.scene, box, 900.0, Vec3(0, 0, -corner.z() - 1e-5),
                                   Quaternion(Eigen::AngleAxisd(turn, Vec3::UnitY())), 0, false);
    Bodies& b = w.scene.bodies;
    b.momentum[i] = b.mass[i] * Vec3(0, 0, 0.5);
    update_derived(b, i);
    step(w);
    // J = (1 + e) v / (1/m + x^2 / I), down on the floe at the lever arm x of the corner
    const double inertia = 900.0 * 0.4 * (1 + 0.16) / 12, x = corner.x();
    const double impulse = 1.3 * 0.5 / (1 / b.mass[i] + x * x / inertia);
    // the spread of normals, which places the corner, is stored as a float
    CHECK(b.velocity[i].z() == Near(0.5 - impulse / b.mass[i]).epsilon(1e-7));
    // moment about y of a force -J e_z at x: x J
    CHECK(b.angular_velocity[i].y() == Near(x * impulse / inertia).epsilon(1e-7));
    CHECK(b.velocity[i].y() == 0.0);
    CHECK(b.angular_velocity[i].x() == 0.0);
    CHECK(b.angular_velocity[i].z() == 0.0);
}

TEST_CASE("drag slows a motion down but never turns it round, however long the step",
          "[step][water]") {
    Case p = test::empty_space(1.0);
    p.drag = GENERATE(DragModel::projected, DragModel::panel);
    p.drag_coefficient = 100.0;
    World w = test::plate_world(p, Vec3(1, 1, 1), 0.1, 0.2, 100.0);
    const auto box = test::add_shape(w, test::make_box_set(Vec3(1, 0.8, 0.3), 0.05, 0.1));
    const std::size_t i =
        add_floe(w.scene, box, 900.0, Vec3(0, 0, -50), Quaternion::Identity(), 0, false);
    Bodies& b = w.scene.bodies;
    b.momentum[i] = b.mass[i] * Vec3(50, 3, 1);
    b.angular_momentum[i] = Vec3(10, 500, 20);
    update_derived(b, i);
    const double energy = kinetic_energy(b);
    for (int k = 0; k < 5; ++k) {
        step(w);
        REQUIRE(kinetic_energy(b) <= energy);
    }
}
