// SPDX-License-Identifier: GPL-3.0-or-later
// A free ship, in the limits where a ship on its course knows the answer.
//
// Tolerances: 1e-6 m is a mass of 4e12 kg in place of an infinite one; 1e-9 is rounding of places
// of metres, over depths of less than a millimetre.
#include <catch2/catch.hpp>
#include <cmath>

#include "solver/run/measure_imbalance.hpp"
#include "tests/support/ships_in_ice.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using namespace ice::test;

namespace {

// The same world in axes that go along with the ship's course: all ice drifts towards the ship.
World drifting(World w) {
    const Vec3 drift(-w.parameters.ship_speed(0.0), 0.0, 0.0);
    w.parameters.speed_table = {{0.0, 0.0}};
    w.scene.water.current = drift;
    Bodies& b = w.scene.bodies;
    for (std::size_t i = 1; i < b.size(); ++i) {
        b.momentum[i] = b.mass[i] * drift;
        update_derived(b, i);
    }
    return w;
}

}  // namespace

TEST_CASE("a ship of a thousand million times the mass moves as one on a prescribed course",
          "[ship]") {
    World prescribed = smooth_ride(4000.0, {});
    World heavy = smooth_ride(4e12, {surge, sway, yaw});
    for (World* w : {&prescribed, &heavy})
        for (int k = 0; k < 100; ++k) step(*w);
    double moved = 0.0;
    for (std::size_t i = 1; i < prescribed.scene.bodies.size(); ++i) {
        const Vec3 &x = prescribed.scene.bodies.position[i], &y = heavy.scene.bodies.position[i];
        CHECK((x - y).norm() < tolerance(1e-6));
        moved = std::max(moved, prescribed.scene.bodies.velocity[i].norm());
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
    for (int k = 0; k < 100; ++k) {
        step(goes);
        step(rests);
        const auto [normal, tangent] = ship_on_ice(goes);
        const auto [normal_2, tangent_2] = ship_on_ice(rests);
        most = std::max(most, normal.norm());
        CAPTURE(k);
        // rounding of places that grow in one world and not in the other
        REQUIRE((normal - normal_2).norm() <= tolerance(1e-9) * (1.0 + most));
        REQUIRE((tangent - tangent_2).norm() <= tolerance(1e-9) * (1.0 + most));
    }
    CHECK(most > 10.0);
}

TEST_CASE("a heavy ship crushes held ice and jams as one on a prescribed course", "[ship][held]") {
    // held before the bow, behind the first row, and released by the hull's touch
    for (const auto& [row, hold] :
         {std::pair(0, Hold::always), {1, Hold::always}, {1, Hold::until_hull_contact}}) {
        World prescribed = rough_ride(4000.0, {}, 6, row);
        // A jam of crushing ice multiplies differences, so that the ship is heavier than in smooth
        // ice: it recoils by 1e-14 m/s.
        World heavy = rough_ride(4e16, {surge, sway, yaw}, 6, row);
        bool held = false, jammed = false;
        for (World* w : {&prescribed, &heavy}) {
            w->parameters.floes[0].hold = hold;
            for (int k = 0; k < 100; ++k) {
                step(*w);
                for (const Constraint& c : w->constraints) {
                    if (c.total_normal() == 0.0 || !c.is_at_bound()) continue;
                    const bool fixed = w->scene.bodies.held[c.b];
                    held = held || (c.a == 0 && fixed);
                    jammed = jammed || (c.a > 0 && fixed);
                }
            }
        }
        CAPTURE(row);
        CHECK((row == 0 ? held : jammed));
        double moved = 0.0;
        for (std::size_t i = 1; i < prescribed.scene.bodies.size(); ++i) {
            const Vec3 &x = prescribed.scene.bodies.position[i],
                       &y = heavy.scene.bodies.position[i];
            CHECK((x - y).norm() < tolerance(1e-6));
            moved = std::max(moved, prescribed.scene.bodies.velocity[i].norm());
        }
        CHECK(moved > 0.1);
        CHECK(
            (prescribed.scene.bodies.position[kShip] - heavy.scene.bodies.position[kShip]).norm() <
            tolerance(1e-6));
    }
}

TEST_CASE("held ice that drifts past a ship at rest is a ship in held ice", "[ship][drift][held]") {
    for (const auto& [row, hold] :
         {std::pair(0, Hold::always), {1, Hold::always}, {1, Hold::until_hull_contact}}) {
        World goes = rough_ride(4000.0, {}, 6, row);
        goes.parameters.floes[0].hold = hold;
        World rests = drifting(goes);
        double most = 0.0;
        bool held = false;
        CAPTURE(row);
        // A jam of crushing ice multiplies rounding, by 1e7 in a hundred steps.
        for (int k = 0; k < 30; ++k) {
            step(goes);
            const Momenta before = momenta_of(rests);
            step(rests);
            REQUIRE_NOTHROW(require_balance(before, rests));
            const auto [normal, tangent] = ship_on_ice(goes);
            const auto [normal_2, tangent_2] = ship_on_ice(rests);
            most = std::max(most, normal.norm());
            REQUIRE((normal - normal_2).norm() <= tolerance(1e-9) * (1.0 + most));
            REQUIRE((tangent - tangent_2).norm() <= tolerance(1e-9) * (1.0 + most));
            for (const Constraint& c : rests.constraints)
                held = held || (c.total_normal() > 0.0 && rests.scene.bodies.held[c.b]);
        }
        CHECK(held);
        CHECK(most > 10.0);
        const Bodies &a = goes.scene.bodies, &b = rests.scene.bodies;
        for (std::size_t i = 1; i < a.size(); ++i) {
            CHECK((a.position[i] - b.position[i] - a.position[kShip]).norm() < tolerance(1e-9));
            CHECK((a.velocity[i] - b.velocity[i] - a.velocity[kShip]).norm() < tolerance(1e-9));
        }
        // the ship is still: the held ice does the work
        CHECK(rests.ledger.ship_work == 0.0);
        const double potential = potential_energy(rests.scene, rests.parameters);
        CHECK(std::abs(rests.ledger.residual(potential)) <
              tolerance(0.005) * std::abs(rests.ledger.drift_work));
    }
}

TEST_CASE("a ship towed through still ice is a moored one that ice and water drift past",
          "[ship][drift]") {
    World towed = smooth_ride(4000.0, {surge}, 2);
    World moored = drifting(towed);
    for (World* w : {&towed, &moored}) {
        w->parameters.ship.damping[surge] = 0.1;  // by the water, of critical
        w->parameters.ship.added_mass[surge] = 0.1;
    }
    towed.parameters.tow = {Vec3::Zero(), 2e4, 0.0};
    moored.parameters.mooring.stiffness[surge] = 2e4;
    double most = 0.0, swing = 0.0;
    // the velocities agree to 1e-13 until rounding turns a decision of the iteration, in step 52
    for (int k = 0; k < 50; ++k) {
        step(towed);
        step(moored);
        const auto [normal, tangent] = ship_on_ice(towed);
        const auto [normal_2, tangent_2] = ship_on_ice(moored);
        most = std::max(most, normal.norm());
        CAPTURE(k);
        REQUIRE((normal - normal_2).norm() <= tolerance(1e-9) * (1.0 + most));
        REQUIRE((tangent - tangent_2).norm() <= tolerance(1e-9) * (1.0 + most));
        const double pull = towed.ship.loads().tow.force.x();
        REQUIRE(pull == Near(moored.ship.loads().mooring.force.x()).margin(1e-9 * 2e4));
        swing = std::max(swing, std::abs(pull));
    }
    CHECK(most > 10.0);
    CHECK(swing > 10.0);
    const Bodies &a = towed.scene.bodies, &b = moored.scene.bodies;
    for (std::size_t i = 0; i < a.size(); ++i)
        CHECK((a.velocity[i] - b.velocity[i] - Vec3::UnitX()).norm() < tolerance(1e-9));
}
