// SPDX-License-Identifier: GPL-3.0-or-later
// The oracle against analytic answers, then our solver against the oracle.
//
// Tolerances: Siconos ends at an error of 1e-7 of the free velocities (siconos_solver.cpp), which
// are 1 m/s; 1e-5 leaves room for the condition of many contacts together. The force on a ship may
// differ by 1e-3: it is a sum over faces whose spheres share a load, which makes the condition
// worse (4e-4 is the most in the steps below).
#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <random>
#include <vector>

#include "tests/siconos/siconos_solver.hpp"
#include "tests/siconos/step_again.hpp"
#include "tests/support/contact_problem.hpp"
#include "tests/support/ships_in_ice.hpp"

using namespace ice;

namespace {

constexpr double kError = 1e-5;

// An immovable body and one of 500 kg that meets it at its centre with this velocity.
struct Meeting {
    Bodies bodies;
    std::vector<Constraint> contacts;
    Meeting(const Vec3& velocity, double friction) {
        for (const double inverse_mass : {0.0, 1.0 / 500.0}) {
            bodies.shape.push_back(0);
            bodies.position.push_back(Vec3::Zero());
            bodies.velocity.push_back(inverse_mass > 0.0 ? velocity : Vec3(Vec3::Zero()));
            bodies.angular_velocity.push_back(Vec3::Zero());
            bodies.inverse_mass.push_back(inverse_mass);
            bodies.inverse_inertia_world.push_back(inverse_mass * Mat3::Identity());
        }
        Constraint c{};
        c.a = 0;
        c.b = 1;
        c.can_move = true;
        c.normal = Vec3(0.6, 0.0, 0.8);
        c.arm_a = c.arm_b = Vec3::Zero();
        c.max_impulse = INFINITY;
        c.friction = friction;
        contacts.push_back(c);
    }
    Vec3 impulse(double target = 0.0) const {
        return oracle::solve_cones(bodies, contacts, std::vector{target}, 1000).impulse.at(0);
    }
};

}  // namespace

TEST_CASE("a body that meets another sticks or slides as Coulomb says", "[analytic]") {
    const Vec3 normal(0.6, 0.0, 0.8), across(0.8, 0.0, -0.6);
    for (const double slip : {0.1, 0.29, 0.31, 2.0}) {
        CAPTURE(slip);
        const Vec3 velocity = -1.0 * normal + slip * across;
        const double friction = std::min(slip, 0.3);  // of the normal impulse, 500 N s
        const Vec3 expected = 500.0 * (normal - friction * across);
        CHECK((Meeting(velocity, 0.3).impulse() - expected).norm() < 500.0 * kError);
    }
}

TEST_CASE("a gap lets a body close by its target, and a body that parts has no impulse",
          "[analytic]") {
    const Vec3 normal(0.6, 0.0, 0.8);
    CHECK((Meeting(-normal, 0.0).impulse(-0.4) - 300.0 * normal).norm() < 500.0 * kError);
    CHECK(Meeting(normal, 0.3).impulse().norm() < 500.0 * kError);
}

TEST_CASE("our solution of random contacts is Siconos'", "[twin]") {
    for (const unsigned seed : {1U, 2U, 3U, 4U, 5U}) {
        CAPTURE(seed);
        std::mt19937 random(seed);
        Bodies bodies = test::make_bodies(40, random);
        if (seed % 2 == 0) test::add_water(bodies, random);
        std::vector<Constraint> contacts = test::make_constraints(bodies, 30, 1, random);
        std::erase_if(contacts, [](const Constraint& c) { return !c.can_move; });
        const auto solution = oracle::solve_cones(
            bodies, contacts, std::vector<double>(contacts.size(), 0.0), 100000);
        Bodies theirs = bodies;
        for (std::size_t k = 0; k < contacts.size(); ++k)
            apply_impulse(theirs, contacts[k], solution.impulse[k]);
        ContactLaw law;
        law.restitution = 0.0;
        law.iterations = 100000;
        law.tolerance = 1e-12;
        REQUIRE(ContactSolver().resolve_impacts(bodies, contacts, law, 0.01).converged);
        double moved = 0.0;
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            CHECK((bodies.velocity[i] - theirs.velocity[i]).norm() < kError);
            CHECK((bodies.angular_velocity[i] - theirs.angular_velocity[i]).norm() < kError);
            moved = std::max(moved, bodies.velocity[i].norm());
        }
        CHECK(moved > 0.1);
    }
}

TEST_CASE("ice that a ship presses has the force of Siconos' solution", "[twin]") {
    World crushing = test::rough_ride(4000.0, {}, 3, 2), rigid = test::smooth_ride(4000.0, {}, 3);
    for (World* world : {&crushing, &rigid}) {
        CAPTURE(world == &crushing);
        world->parameters.contact.restitution = 0.0;
        Vec3 sum = Vec3::Zero();
        std::size_t at_bound = 0;
        for (int k = 0; k < 100; ++k) {
            const Bodies before = world->scene.bodies;
            step(*world);
            if (k % 20 != 19) continue;
            const oracle::StepAgain again = oracle::solve_again(before, *world, 20000);
            CAPTURE(k, again.contacts, again.error);
            CHECK((again.ours - again.siconos).norm() <= 1e-3 * again.siconos.norm());
            sum += again.siconos;
            at_bound += again.at_bound;
        }
        CHECK(sum.x() < -10.0);
        CHECK((at_bound > 0) == (world == &crushing));
    }
}
