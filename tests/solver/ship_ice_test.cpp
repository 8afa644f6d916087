// SPDX-License-Identifier: GPL-3.0-or-later
// A ship that answers the ice: impacts, momentum, many floes at once, held ice, the captive limit.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "common/base/parallel.hpp"
#include "solver/record/recorder.hpp"
#include "solver/run/balance.hpp"
#include "tests/support/every_instruction_set.hpp"
#include "tests/support/make_worlds.hpp"

using namespace ice;
using namespace ice::test;

namespace {

// A box of 4 x breadth x 1 m without water, free as told, at 1 m/s.
World box_ship(double mass, double breadth, std::initializer_list<Freedom> free) {
    Case p = empty_space(0.01);
    p.contact.friction_ship_ice = 0.0;
    p.speed_table = {{0.0, 1.0}};
    for (const Freedom k : free) p.ship.free[k] = true;
    p.ship.mass = mass;
    p.ship.centre_of_gravity = Vec3::Zero();
    p.ship.gyration = Vec3(1.0, 1.5, 1.5);
    return plate_world(p, Vec3(4, breadth, 1), 0.1, 0.4, -0.5);
}

Vec3 momentum_of(const World& w) {
    Vec3 sum = w.scene.bodies.momentum[kShip];
    for (const std::int32_t i : w.scene.bodies.moving) sum += w.scene.bodies.momentum[i];
    return sum;
}

// Ice that a ship with a bow pushes and shears, with water: 5 rows of 6 floes under an inclined box
World rough_ride(double mass, std::initializer_list<Freedom> free, int rows = 6) {
    Case p = empty_space(0.01);
    p.gravity = 9.81;
    p.buoyancy = BuoyancyModel::distributed;
    p.drag = DragModel::panel;
    p.speed_table = {{0.0, 1.0}};
    p.contact.crushing_pressure = 2e5;
    p.contact.iterations = 30;
    p.contact.tolerance = 1e-4;
    for (const Freedom k : free) p.ship.free[k] = true;
    p.ship.mass = mass;
    p.ship.centre_of_gravity = Vec3::Zero();
    World w = plate_world(p, Vec3(4, 2, 1), 0.1, 0.25, -0.5);
    const auto box = add_shape(w, make_box_set(Vec3(0.8, 0.6, 0.2), 0.05, 0.1));
    for (int row = 0; row < rows; ++row)
        for (int k = 0; k < 5; ++k)
            add_floe(w.scene, box, 900.0, Vec3(2.45 + 0.85 * row, -1.28 + 0.64 * k, -0.08),
                     Quaternion(Eigen::AngleAxisd(0.02 * (row - k), Vec3::UnitZ())), 0,
                     row == 5 && k == 2);
    w.parameters.floes[0].hold = Hold::until_hull_contact;
    return w;
}

// The same without held ice and crushing, solved as far as rounding lets it: two of these worlds
// that differ by rounding do so after a hundred steps, too. Ice that crushes in a jam multiplies
// it.
World smooth_ride(double mass, std::initializer_list<Freedom> free, int rows = 6) {
    World w = rough_ride(mass, free, rows);
    Case& p = w.parameters;
    p.contact.crushing_pressure = std::numeric_limits<double>::infinity();
    p.contact.friction_ice_ice = 0.1;
    p.contact.iterations = 2000;
    p.contact.tolerance = 1e-11;
    p.floes[0].hold = Hold::never;
    for (std::size_t i = 1; i < w.scene.bodies.size(); ++i)
        if (w.scene.bodies.held[i]) release(w.scene.bodies, i);
    return w;
}

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
              Approx(1.0 - (1.0 + e) * m_f / (m_s + m_f)).epsilon(1e-11));
        CHECK(w.scene.bodies.velocity[1].x() ==
              Approx((1.0 + e) * m_s / (m_s + m_f)).epsilon(1e-11));
    }
}

TEST_CASE("an oblique hit turns a ship that is free to turn", "[ship][contact]") {
    World w = box_ship(3000.0, 2.0, {surge, sway, yaw});
    w.parameters.contact.restitution = 0.5;
    // one column of spheres
    const auto box = add_shape(w, make_box_set(Vec3(1, 0.2, 1), 0.1, 0.4));
    add_floe(w.scene, box, 900.0, Vec3(2.505, 0.7, 0), Quaternion::Identity(), 0, false);
    const double m_f = w.scene.bodies.mass[1];
    const double spin_f = w.scene.bodies.inertia(1)(2, 2);
    step(w);
    // pairs of contacts above and below the middle, at one place along y
    double arm = 0.0, arm_f = 0.0;
    for (const Constraint& c : w.constraints) {
        if (c.total_normal() == 0.0) continue;
        REQUIRE((arm == 0.0 || arm == Approx(c.arm_a.y()).epsilon(1e-12)));
        arm = c.arm_a.y();
        arm_f = c.arm_b.y();
    }
    REQUIRE(arm == Approx(0.7).margin(0.15));
    const double inertia = 3000.0 * 1.5 * 1.5;
    const double k = 1.0 / m_f + 1.0 / 3000.0 + arm * arm / inertia + arm_f * arm_f / spin_f;
    const double impulse = 1.5 / k;
    CHECK(w.scene.bodies.velocity[kShip].x() == Approx(1.0 - impulse / 3000.0).epsilon(1e-9));
    CHECK(w.scene.bodies.angular_velocity[kShip].z() ==
          Approx(arm * impulse / inertia).epsilon(1e-9));
}

TEST_CASE("ship and floes together keep their momentum", "[ship][contact][balance]") {
    World w = box_ship(2000.0, 2.0, {surge, sway, heave, roll, pitch, yaw});
    w.parameters.contact.friction_ship_ice = 0.2;
    w.parameters.contact.iterations = 30;
    w.parameters.contact.tolerance = 1e-4;
    w.parameters.ship.added_mass = {0.1, 0.6, 0.9, 0.2, 0.7, 0.3};
    const auto box = add_shape(w, make_box_set(Vec3(0.8, 0.6, 0.3), 0.05, 0.1));
    for (int k = 0; k < 8; ++k)
        add_floe(w.scene, box, 900.0,
                 Vec3(2.6 + 0.9 * (k / 3), -0.7 + 0.7 * (k % 3), 0.1 * (k % 2)),
                 Quaternion(Eigen::AngleAxisd(0.2 * k, Vec3(1, 2, 3).normalized())), 0, false);
    step(w);
    double impulse = 0.0;
    for (int k = 0; k < 150; ++k) {
        // the ship's own momentum turns with its added mass: within a step it balances
        const Vec3 mass_velocity = w.scene.bodies.velocity[kShip];
        Vec3 floes = momentum_of(w) - w.scene.bodies.momentum[kShip];
        step(w);
        const Bodies& b = w.scene.bodies;
        const Vec3 gained = momentum_of(w) - b.momentum[kShip] - floes;
        const Vec3 lost = b.ship.inverse_mass.inverse() * (b.velocity[kShip] - mass_velocity);
        const Vec3 sum = gained + lost;
        double size = 0.0;
        for (const Constraint& c : w.constraints)
            if (c.a == 0) size += c.total_normal() + c.total_tangent().norm();
        impulse += size;
        // rounding: of momenta of some tons at m/s, 1e-16 each
        REQUIRE(sum.norm() <= 1e-12 * (size + 2000.0));
    }
    CHECK(impulse > 100.0);
    CHECK(w.scene.bodies.angular_velocity[kShip].norm() > 1e-3);
}

TEST_CASE("every step of a free ship in ice balances as one of a captive ship", "[ship][balance]") {
    World w = rough_ride(4000.0, {surge, sway, heave, roll, pitch, yaw});
    step(w);
    for (int k = 0; k < 150; ++k) {
        const Momenta before = momenta_of(w.scene.bodies);
        step(w);
        REQUIRE_NOTHROW(require_balance(before, w));
    }
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
        CHECK(w.scene.bodies.velocity[kShip].x() == Approx(common).epsilon(1e-6));
        for (std::size_t i = 1; i <= 50; ++i)
            CHECK(w.scene.bodies.velocity[i].x() == Approx(common).epsilon(1e-6));
    }
}

TEST_CASE("a ship that rams held ice stops or comes back", "[ship][held]") {
    SECTION("rigid ice: with the restitution, for which a captive ship has no answer") {
        for (const double e : {0.0, 0.3}) {
            World w = box_ship(3000.0, 2.0, {surge});
            w.parameters.contact.restitution = e;
            w.parameters.floes[0].hold = Hold::always;
            const auto box = add_shape(w, make_box_set(Vec3(1, 1, 1), 0.1, 0.4));
            add_floe(w.scene, box, 900.0, Vec3(2.505, 0, 0), Quaternion::Identity(), 0, true);
            for (int k = 0; k < 3; ++k) step(w);
            CHECK(w.scene.bodies.velocity[kShip].x() == Approx(-e).margin(1e-10));
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
                crushed = crushed || (c.total_normal() > 0.0 && c.crushed());
            }
            const double now = w.scene.bodies.velocity[kShip].x();
            REQUIRE(now == Approx(speed - strength / 3000.0).margin(1e-12));
            speed = now;
        }
        CHECK(crushed);
        CHECK(speed == Approx(0.0).margin(1e-6));
    }
    SECTION("a wall beside a ship that only heaves: as captive along it, rubbed down to rest") {
        World w = box_ship(3000.0, 2.0, {heave});
        w.parameters.contact.crushing_pressure = 1e5;
        w.parameters.contact.friction_ship_ice = 0.1;
        w.parameters.floes[0].hold = Hold::always;
        const auto box = add_shape(w, make_box_set(Vec3(1, 1, 1), 0.1, 0.4));
        add_floe(w.scene, box, 900.0, Vec3(2.505, 0, 0), Quaternion::Identity(), 0, true);
        for (int k = 0; k < 20; ++k) step(w);
        CHECK(w.scene.bodies.velocity[kShip] == Vec3(1, 0, 0));
        CHECK(w.scene.bodies.position[kShip].x() == Approx(0.2));
    }
}

TEST_CASE("a ship of a thousand million times the mass goes as a captive one", "[ship]") {
    World captive = smooth_ride(4000.0, {});
    World heavy = smooth_ride(4e12, {surge, sway, yaw});
    for (World* w : {&captive, &heavy})
        for (int k = 0; k < 100; ++k) step(*w);
    double moved = 0.0;
    for (std::size_t i = 1; i < captive.scene.bodies.size(); ++i) {
        const Vec3 &x = captive.scene.bodies.position[i], &y = heavy.scene.bodies.position[i];
        CHECK((x - y).norm() < 1e-6);
        moved = std::max(moved, captive.scene.bodies.velocity[i].norm());
    }
    CHECK(moved > 0.1);
}

TEST_CASE("ice that drifts past a ship at rest is a ship in still ice", "[ship][drift]") {
    World goes = smooth_ride(4000.0, {}, 1), rests = smooth_ride(4000.0, {}, 1);
    rests.parameters.speed_table = {{0.0, 0.0}};
    rests.scene.water.current = Vec3(-1.0, 0.0, 0.0);
    Bodies& b = rests.scene.bodies;
    for (const std::int32_t i : b.moving) {
        b.momentum[i] = b.mass[i] * Vec3(-1.0, 0.0, 0.0);
        update_derived(b, static_cast<std::size_t>(i));
    }
    double most = 0.0;
    for (int k = 0; k < 60; ++k) {
        step(goes);
        step(rests);
        const auto [normal, tangent] = ship_on_ice(goes);
        const auto [normal_2, tangent_2] = ship_on_ice(rests);
        most = std::max(most, normal.norm());
        CAPTURE(k);
        // rounding of places that grow in one world and not in the other
        REQUIRE((normal - normal_2).norm() <= 1e-9 * (1.0 + most));
        REQUIRE((tangent - tangent_2).norm() <= 1e-9 * (1.0 + most));
    }
    CHECK(most > 10.0);
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
