// SPDX-License-Identifier: GPL-3.0-or-later
// A free ship: impacts, many floes at once, held ice.
//
// Tolerances: 1e-12 and 1e-11 are rounding of sums over the contacts; 1e-10 and 1e-9 are a few
// hundred of the solver's stops at 1e-12 m/s; 1e-6 is as many at 1e-9 m/s.
#include <catch2/catch.hpp>
#include <cmath>

#include "common/base/parallel.hpp"
#include "solver/record/recorder.hpp"
#include "tests/support/every_instruction_set.hpp"
#include "tests/support/ships_in_ice.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using namespace ice::test;

namespace {

std::uint64_t hash_after(int steps) {
    World w = rough_ride(4000.0, {surge, sway, heave, roll, pitch, yaw});
    for (int k = 0; k < steps; ++k) step(w);
    REQUIRE(w.scene.bodies.velocity[kShip].x() < 0.9);
    return state_hash(w.scene, w.constraints);
}

}  // namespace

TEST_CASE("one ship and one floe part as Newton's restitution says", "[ship][contact]") {
    for (const double e : {0.0, 0.3, 1.0}) {
        World w = box_ship(3000.0, 2.0, {surge});
        w.parameters.contact.restitution = e;
        const auto box = add_shape(w, make_box_set(Vec3(1, 1, 1), 0.1, 0.4));
        add_floe(w.scene, box, 900.0, Vec3(2.505, 0, 0), Quaternion::Identity(), 0, false);
        const double m_f = w.scene.bodies.mass[1], m_s = 3000.0;
        for (int k = 0; k < 3; ++k) step(w);
        CAPTURE(e);
        CHECK(w.scene.bodies.velocity[kShip].x() ==
              Near(1.0 - (1.0 + e) * m_f / (m_s + m_f)).epsilon(1e-11));
        CHECK(w.scene.bodies.velocity[1].x() == Near((1.0 + e) * m_s / (m_s + m_f)).epsilon(1e-11));
    }
}

TEST_CASE("an oblique hit turns a ship that is free to turn", "[ship][contact]") {
    World w = box_ship(3000.0, 2.0, {surge, sway, yaw});
    w.parameters.contact.restitution = 0.5;
    // the floe's upright edge that is nearest to the ship is 5 mm before the bow
    const auto box = add_shape(w, make_box_set(Vec3(1, 0.2, 1), 0.1, 0.4));
    const Quaternion turned(Eigen::AngleAxisd(0.3, Vec3::UnitZ()));
    const Vec3 edge = turned * Vec3(-0.5, 0.1, 0.0);
    add_floe(w.scene, box, 900.0, Vec3(2.005, 0.7, 0) - edge, turned, 0, false);
    const double m_f = w.scene.bodies.mass[1];
    const double spin_f = w.scene.bodies.inertia(1)(2, 2);
    step(w);
    // contacts at the upper and at the lower end of the edge
    double arm = 0.0, arm_f = 0.0;
    for (const Constraint& c : w.constraints) {
        if (c.total_normal() == 0.0) continue;
        REQUIRE((arm == 0.0 || arm == Near(c.arm_a.y()).epsilon(1e-12)));
        arm = c.arm_a.y();
        arm_f = c.arm_b.y();
    }
    REQUIRE(arm == Near(0.7).epsilon(1e-9));
    REQUIRE(arm_f == Near(edge.y()).epsilon(1e-9));
    const double inertia = 3000.0 * 1.5 * 1.5;
    const double k = 1.0 / m_f + 1.0 / 3000.0 + arm * arm / inertia + arm_f * arm_f / spin_f;
    const double impulse = 1.5 / k;
    CHECK(w.scene.bodies.velocity[kShip].x() == Near(1.0 - impulse / 3000.0).epsilon(1e-9));
    CHECK(w.scene.bodies.angular_velocity[kShip].z() ==
          Near(arm * impulse / inertia).epsilon(1e-9));
}

TEST_CASE("an overlap opens by ship and floe in the ratio of their masses", "[ship][overlaps]") {
    World w = box_ship(3000.0, 2.0, {surge});
    w.parameters.speed_table = {{0.0, 0.0}};
    w.parameters.ship.added_mass = {0.5, 0.0, 0.0, 0.0, 0.0, 0.0};
    const auto box = add_shape(w, make_box_set(Vec3(1, 1, 1), 0.1, 0.4));
    const double overlap = 0.02;
    const bool held = GENERATE(false, true);
    w.parameters.floes[0].hold = held ? Hold::always : Hold::never;
    add_floe(w.scene, box, 900.0, Vec3(2.5 - overlap, 0, 0), Quaternion::Identity(), 0, held);
    step(w);
    const double ship = w.scene.bodies.position[kShip].x();
    const double floe = w.scene.bodies.position[1].x() - 2.5 + overlap;
    if (held)
        CHECK(w.scene.bodies.position[1].x() == 2.5 - overlap);
    else
        CHECK(floe / ship == Near(-4500.0 / w.scene.bodies.mass[1]).epsilon(1e-12));
    // a tenth of it in a step of a hundredth of a second, but for what is left alone
    CHECK(floe - ship == Near(0.1 * (overlap - kToleratedOverlap * 0.1)).epsilon(1e-6));
    CHECK(w.scene.bodies.velocity[kShip].x() == 0.0);
}

TEST_CASE("fifty floes abreast take a ship of any mass along at their common speed",
          "[ship][contact]") {
    for (const double share : {0.2, 2.0, 20.0}) {
        World probe = box_ship(1.0, 50.0, {surge});
        const double floe =
            900.0 * build_shape(make_box_set(Vec3(1, 0.9, 1), 0.1, 0.4), true).solid.volume;
        World w = box_ship(share * 50.0 * floe, 50.0, {surge});
        w.parameters.contact.restitution = 0.0;
        w.parameters.contact.iterations = 300;
        w.parameters.contact.tolerance = 1e-9;
        const auto box = add_shape(w, make_box_set(Vec3(1, 0.9, 1), 0.1, 0.4));
        for (int k = 0; k < 50; ++k)
            add_floe(w.scene, box, 900.0, Vec3(2.505, -24.5 + k, 0), Quaternion::Identity(), 0,
                     false);
        step(w);
        REQUIRE(w.impacts.converged);
        CAPTURE(share, w.impacts.iterations);
        const double common = share / (1.0 + share);
        CHECK(w.scene.bodies.velocity[kShip].x() == Near(common).epsilon(1e-6));
        for (std::size_t i = 1; i <= 50; ++i)
            CHECK(w.scene.bodies.velocity[i].x() == Near(common).epsilon(1e-6));
    }
}

TEST_CASE("a ship that rams held ice stops or comes back", "[ship][held]") {
    SECTION("rigid ice: with the restitution, for which a prescribed course has no solution") {
        for (const double e : {0.0, 0.3}) {
            World w = box_ship(3000.0, 2.0, {surge});
            w.parameters.contact.restitution = e;
            w.parameters.floes[0].hold = Hold::always;
            const auto box = add_shape(w, make_box_set(Vec3(1, 1, 1), 0.1, 0.4));
            add_floe(w.scene, box, 900.0, Vec3(2.505, 0, 0), Quaternion::Identity(), 0, true);
            for (int k = 0; k < 3; ++k) step(w);
            CHECK(w.scene.bodies.velocity[kShip].x() == Near(-e).margin(1e-10));
        }
    }
    SECTION("ice that crushes: by what its strength allows in a step, until it stands") {
        World w = box_ship(3000.0, 2.0, {surge});
        w.parameters.contact.restitution = 0.0;
        w.parameters.contact.crushing_pressure = 1e4;
        w.parameters.floes[0].hold = Hold::always;
        const auto box = add_shape(w, make_box_set(Vec3(1, 1, 1), 0.1, 0.4));
        add_floe(w.scene, box, 900.0, Vec3(2.505, 0, 0), Quaternion::Identity(), 0, true);
        double speed = 1.0;
        bool crushed = false;
        for (int k = 0; k < 300; ++k) {
            step(w);
            double strength = 0.0;
            for (const Constraint& c : w.constraints) {
                strength += c.total_normal();
                crushed = crushed || (c.total_normal() > 0.0 && c.is_at_bound());
            }
            const double now = w.scene.bodies.velocity[kShip].x();
            REQUIRE(now == Near(speed - strength / 3000.0).margin(1e-12));
            speed = now;
        }
        CHECK(crushed);
        CHECK(speed == Near(0.0).margin(1e-6));
    }
    SECTION(
        "a wall beside a ship that only heaves: as on a prescribed course along it, rubbed down to "
        "rest") {
        World w = box_ship(3000.0, 2.0, {heave});
        w.parameters.contact.crushing_pressure = 1e5;
        w.parameters.contact.friction_ship_ice = 0.1;
        w.parameters.floes[0].hold = Hold::always;
        const auto box = add_shape(w, make_box_set(Vec3(1, 1, 1), 0.1, 0.4));
        add_floe(w.scene, box, 900.0, Vec3(2.505, 0, 0), Quaternion::Identity(), 0, true);
        for (int k = 0; k < 20; ++k) step(w);
        CHECK(w.scene.bodies.velocity[kShip] == Vec3(1, 0, 0));
        CHECK(w.scene.bodies.position[kShip].x() == Near(0.2));
    }
}

TEST_CASE("a ship of which every motion is locked has the bits of one that has no mass",
          "[ship][determinism]") {
    World plain = rough_ride(4000.0, {}), locked = rough_ride(4000.0, {});
    plain.parameters.ship = {};
    locked.parameters.ship.gyration = Vec3(1.0, 2.0, 3.0);
    locked.parameters.ship.added_mass.fill(0.3);
    locked.parameters.ship.damping.fill(0.1);
    for (int k = 0; k < 60; ++k) {
        step(plain);
        step(locked);
    }
    CHECK(state_hash(plain.scene, plain.constraints) ==
          state_hash(locked.scene, locked.constraints));
}

TEST_CASE("a free ship has the same bits for all threads and instruction sets",
          "[ship][determinism]") {
    const int before = thread_count();
    set_thread_count(1);
    const std::uint64_t expected = hash_after(60);
    for (const int threads : {2, 8}) {
        set_thread_count(threads);
        CHECK(hash_after(60) == expected);
    }
    set_thread_count(before);
    on_every_instruction_set([&] { CHECK(hash_after(60) == expected); });
}
