// SPDX-License-Identifier: GPL-3.0-or-later
// The check of momentum: it passes what balances and names what does not.
//
// Tolerances: 1e-14 is rounding of a few momenta of one size, 1e-16 each.
#include <algorithm>
#include <catch2/catch.hpp>

#include "common/base/error.hpp"
#include "solver/run/measure_imbalance.hpp"
#include "solver/water/hydrostatics.hpp"
#include "tests/support/make_worlds.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::tolerance;

namespace {

// Two floes, one above the other, pressed under a plate that moves: every kind of contact and load.
World pressed_floes() {
    Case p = test::empty_space(0.01);
    p.gravity = 9.81;
    p.buoyancy = BuoyancyModel::distributed;
    p.drag = DragModel::panel;
    p.speed_table = {{0.0, 1.0}};
    p.contact.iterations = 30;
    p.contact.tolerance = 1e-4;
    World w = test::plate_world(p, Vec3(8, 4, 0.4), 0.1, 0.2, -1.0);
    const auto box = test::add_shape(w, test::make_box_set(Vec3(1, 0.8, 0.3), 0.05, 0.1));
    for (const double z : {-1.16, -1.47})
        add_floe(w.scene, box, 900.0, Vec3(0, 0, z),
                 Quaternion(Eigen::AngleAxisd(0.1 * z, Vec3::UnitX())), 0, false);
    return w;
}

Momenta advance(World& w, int steps) {
    Momenta before;
    for (int k = 0; k < steps; ++k) {
        before = momenta_of(w);
        step(w);
    }
    return before;
}

// the contact of the ship that carries the largest impulse: of a small one a billionth is rounding
Constraint& pressed_contact(World& w) {
    const auto load = [](const Constraint& c) { return c.a == 0 ? c.total_normal() : 0.0; };
    const auto most = std::max_element(
        w.constraints.begin(), w.constraints.end(),
        [&](const Constraint& l, const Constraint& r) { return load(l) < load(r); });
    REQUIRE(most != w.constraints.end());
    REQUIRE(load(*most) > 0.0);
    return *most;
}

}  // namespace

TEST_CASE("every step of two pressed floes balances", "[step][balance]") {
    World w = pressed_floes();
    for (int k = 0; k < 200; ++k) {
        const Momenta before = advance(w, 1);
        REQUIRE_NOTHROW(require_balance(before, w));
    }
    CHECK(pressed_contact(w).total_normal() > 0.0);
}

TEST_CASE("floes that float at rest and touch nothing balance from the first step on",
          "[step][balance]") {
    World w = pressed_floes();
    w.scene.bodies.position[kShip].z() += 100.0;
    for (std::size_t i = 1; i < w.scene.bodies.size(); ++i) {
        Bodies& b = w.scene.bodies;
        b.position[i] = Vec3(7.0 * double(i), 3.0, 0.0);
        b.position[i].z() =
            floating_height(w.scene.shapes[std::size_t(b.shape[i])], b.rotation[i], 0.9);
    }
    for (int k = 0; k < 20; ++k) {
        const Momenta before = advance(w, 1);
        REQUIRE(w.constraints.empty());
        const Imbalance found = require_balance(before, w);
        // the loads are there on both sides: what is left is their own rounding
        CHECK(found.together < tolerance(1e-14));
    }
}

TEST_CASE("an impulse off by 1e-9 of itself is caught, with the step and the floe",
          "[step][balance]") {
    World w = pressed_floes();
    const Momenta before = advance(w, 50);
    REQUIRE_NOTHROW(require_balance(before, w));
    Constraint& c = pressed_contact(w);
    SECTION("a normal impulse that the floe did not get") {
        c.rest_normal *= 1.0 + 1e-9;
        CHECK_THROWS_WITH(require_balance(before, w), Catch::Contains("step 50, floe 1"));
    }
    SECTION("a tangential one") {
        c.rest_tangent += Vec3(1e-9 * c.total_normal(), 0, 0);
        CHECK_THROWS_WITH(require_balance(before, w), Catch::Contains("step 50, floe 1"));
    }
    SECTION("one that acts at another place") {
        c.arm_b += Vec3(1e-6, 0, 0);
        CHECK_THROWS_WITH(require_balance(before, w), Catch::Contains("angular momentum"));
    }
    SECTION("a floe that is given some on its way") {
        w.scene.bodies.momentum[2] += Vec3(0, 1e-9 * w.scene.bodies.momentum[2].norm(), 0);
        CHECK_THROWS_WITH(require_balance(before, w), Catch::Contains("floe 2"));
    }
    SECTION("a state that is no number") {
        w.scene.bodies.momentum[2].x() = std::numeric_limits<double>::quiet_NaN();
        CHECK_THROWS_AS(require_balance(before, w), Error);
    }
}

TEST_CASE("what a held floe takes counts as momentum that left", "[step][balance]") {
    World w = pressed_floes();
    w.parameters.floes.resize(2);
    w.parameters.floes[1].hold = Hold::always;
    w.scene.bodies.group[1] = 1;
    w.scene.bodies.held[1] = 1;
    update_derived(w.scene.bodies, 1);
    const Momenta before = advance(w, 50);
    const Imbalance found = require_balance(before, w);
    CHECK(found.linear_floe != 1);
    CHECK(found.together <= kBalanceTolerance);
    CHECK(w.scene.bodies.momentum[1] == Vec3::Zero());
}
