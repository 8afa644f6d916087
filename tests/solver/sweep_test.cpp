// SPDX-License-Identifier: GPL-3.0-or-later
// The solver's sweeps: blocks share no free body, bits on every instruction set.
//
// Tolerances: 1e-15 is rounding of one row's impulse, 1e-12 that of a few sweeps over it.
#include "solver/contact/sweep.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "solver/contact/conjugate_gradient.hpp"
#include "tests/support/contact_problem.hpp"
#include "tests/support/every_instruction_set.hpp"
#include "tests/support/same_bits.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;
using ice::test::tolerance;
using test::ContactProblem;
using test::make_bodies;
using test::same_bits;

namespace {

std::vector<RowImpulses> impulses_of(const ContactRows& contacts) {
    std::vector<RowImpulses> out;
    for (const ContactRow& row : contacts.rows) out.push_back(row.impulse);
    return out;
}

}  // namespace

TEST_CASE("no two pairs of a block, nor of blocks of one colour, share a free body", "[sweep]") {
    ContactProblem problem(GENERATE(1u, 8u, 9u, 300u), 5, 3);
    const ContactRows& contacts = problem.contacts;
    std::size_t pairs = 0, rows = 0;
    for (std::size_t k = 0; k < contacts.blocks.size();) {
        const std::int32_t colour = contacts.blocks[k].colour;
        std::vector<std::int32_t> seen;
        std::int32_t most = contacts.blocks[k].rows;
        for (; k < contacts.blocks.size() && contacts.blocks[k].colour == colour; ++k) {
            const PairBlock& block = contacts.blocks[k];
            CHECK(block.rows <= most);  // what the sweep of two blocks at a time relies on
            most = block.rows;
            rows += static_cast<std::size_t>(block.rows);
            for (std::size_t lane = 0; lane < kLanes; ++lane) {
                if (block.a[lane] < 0) continue;
                ++pairs;
                if (block.inverse_mass_a.v[lane] > 0.0) seen.push_back(block.a[lane]);
                if (block.inverse_mass_b.v[lane] > 0.0) seen.push_back(block.b[lane]);
            }
        }
        std::sort(seen.begin(), seen.end());
        CHECK(std::adjacent_find(seen.begin(), seen.end()) == seen.end());
    }
    CHECK(rows == contacts.rows.size());
    std::size_t expected = 0;
    std::pair<std::int32_t, std::int32_t> last{-1, -1};
    for (const std::int32_t k : problem.which) {
        const Constraint& c = problem.constraints[static_cast<std::size_t>(k)];
        if (std::pair(c.a, c.b) != last && c.can_move) ++expected;
        last = {c.a, c.b};
    }
    CHECK(pairs == expected);
}

TEST_CASE("a floe with more neighbours than there are colours is solved with all of them",
          "[sweep]") {
    std::mt19937 random(5);
    Bodies bodies = make_bodies(200, random);
    std::vector<Contact> contacts;
    for (std::int32_t k = 2; k < 200; ++k) {
        Contact c{};
        c.a = 1;
        c.b = k;
        c.point = bodies.position[1];
        c.normal = Vec3::UnitX();
        contacts.push_back(c);
    }
    std::vector<Constraint> constraints;
    ContactLaw law;
    law.crushing_pressure = std::numeric_limits<double>::infinity();
    build_constraints(bodies, contacts, law, 0.0, constraints);
    ContactRows rows;
    std::vector<std::int32_t> all(constraints.size());
    std::iota(all.begin(), all.end(), 0);
    rows.build(bodies, constraints, all);
    CHECK(rows.blocks.size() == 198);  // body 1 is free: no two of its pairs share a block
}

TEST_CASE("one contact is brought to its conditions by one sweep", "[sweep][analytic]") {
    // 2 and 3 kg meet head-on at 1 and -4 m/s; they should part at 0.5 m/s
    Bodies bodies;
    for (const double mass : {2.0, 3.0}) {
        bodies.shape.push_back(0);
        bodies.inverse_mass.push_back(1.0 / mass);
        bodies.inverse_inertia_world.push_back(Mat3::Identity());
        bodies.angular_velocity.push_back(Vec3::Zero());
    }
    bodies.position = {Vec3::Zero(), Vec3(2, 0, 0)};
    bodies.velocity = {Vec3(1, 0, 0), Vec3(-4, 0, 0)};
    Contact contact{};
    contact.b = 1;
    contact.point = Vec3(1, 0, 0);
    contact.normal = Vec3::UnitX();
    ContactLaw law;
    law.crushing_pressure = std::numeric_limits<double>::infinity();
    std::vector<Constraint> constraints;
    build_constraints(bodies, {contact}, law, 0.0, constraints);
    ContactRows rows;
    rows.build(bodies, constraints, {0});
    rows.begin_stage(bodies, constraints, &Constraint::rest_normal, &Constraint::rest_tangent,
                     [](const Constraint&) {
                         return ContactRows::Target{0.5, 1e9};
                     });
    CHECK(sweep(rows.blocks, rows.rows, rows.motion) == Near(5.5).epsilon(1e-15));
    CHECK(sweep(rows.blocks, rows.rows, rows.motion) <= tolerance(1e-15));
    rows.end_stage(bodies, constraints, &Constraint::rest_normal, &Constraint::rest_tangent);
    CHECK(constraints[0].rest_normal == Near(5.5 * 6.0 / 5.0).epsilon(1e-15));
    CHECK(bodies.velocity[0].x() == Near(1.0 - 3.3).epsilon(1e-15));
    CHECK(bodies.velocity[1].x() == Near(-4.0 + 2.2).epsilon(1e-15));
}

TEST_CASE("every instruction set sweeps to the bits of the reference", "[sweep][simd]") {
    const std::size_t pairs = GENERATE(1u, 2u, 3u, 5u, 7u, 8u, 9u, 17u, 400u);
    ContactProblem problem(pairs, 6, static_cast<unsigned>(pairs), GENERATE(false, true));
    ContactRows& contacts = problem.contacts;
    const auto run = [&](const auto& sweep_once, const auto& change, const auto& go_on) {
        problem.begin();
        SweepMemory memory;
        memory.before = impulses_of(contacts);
        memory.direction.assign(contacts.rows.size(), RowImpulses{});
        memory.motion_before = contacts.motion;
        memory.motion_direction.assign(contacts.motion.size(), BodyMotion{});
        std::vector<double> out;
        for (int k = 0; k < 4; ++k) {
            out.push_back(
                sweep_once(contacts.blocks, contacts.rows, contacts.motion, contacts.excess));
            out.push_back(change(contacts.rows, memory));
            go_on(contacts.rows, contacts.motion, 0.3, memory);
        }
        return out;
    };
    const auto expected = run(reference::sweep, reference::measure_change, reference::move_on);
    const auto expected_impulses = impulses_of(contacts);
    const auto expected_motion = contacts.motion;
    if (pairs > 8) REQUIRE(expected[0] > 0.0);  // or nothing is compared
    test::on_every_instruction_set([&] {
        CHECK(same_bits(run(sweep, measure_change, move_on), expected));
        CHECK(same_bits(impulses_of(contacts), expected_impulses));
        CHECK(same_bits(contacts.motion, expected_motion));
    });
}

TEST_CASE(
    "conjugate gradients go on along steady sweeps where ice can crush, and restart where "
    "nothing is crushed",
    "[sweep][analytic]") {
    const bool bounded = GENERATE(true, false);
    const double ratio = GENERATE(0.5, 0.75, 0.9, 1.0, 1.04, 1.3);  // |g|^2 over the last one
    CAPTURE(bounded, ratio);
    ContactRows contacts;
    contacts.rows.resize(1);
    ContactRow& row = contacts.rows[0];
    row.inverse_effective_mass.v[3] = 1e-3;
    double& impulse = row.impulse.normal.v[3];
    ConjugateGradient gradient;
    gradient.begin(contacts, bounded);
    impulse += 1.0;
    gradient.advance(contacts);
    CHECK(impulse == 1.0);  // there is no direction yet
    const double second = std::sqrt(ratio);
    impulse += second;
    gradient.advance(contacts);
    // the limits lie between 0.75 and 0.9 for rigid bodies, 1.04 and 1.3 for ice that crushes
    const bool goes_on = bounded ? ratio < 1.1 : ratio < 0.8;
    const double beta = goes_on ? std::min(ratio, 1.0) : 0.0;
    CHECK(impulse == Near(1.0 + second + beta).epsilon(1e-12));
    impulse += 0.1;  // a small step follows: the direction is beta p + g
    gradient.advance(contacts);
    const double next = 0.01 / ratio;
    CHECK(impulse == Near(1.1 + second + beta + next * (beta + second)).epsilon(1e-12));
}
