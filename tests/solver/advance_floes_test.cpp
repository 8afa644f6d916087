// SPDX-License-Identifier: GPL-3.0-or-later
// Motion of floes in lanes: bits on every instruction set, whatever floes lie beside each other.
#include "solver/integrate/advance_floes.hpp"

#include <catch2/catch.hpp>
#include <random>

#include "solver/integrate/rotation.hpp"
#include "tests/support/dice.hpp"
#include "tests/support/every_instruction_set.hpp"
#include "tests/support/same_bits.hpp"

using namespace ice;

namespace {

using test::Dice;

// Floes of about a ton and a metre after a step, the ship first. They turn by up to `angle` [rad].
struct Floes {
    Bodies bodies;
    std::vector<Vec3> start;
    PositionCorrections corrections;

    Floes(std::size_t count, int inertias, double angle, Dice& dice) {
        Bodies& b = bodies;
        for (int k = 0; k < inertias; ++k) {
            const Quaternion axes = exponential_map(dice.vector());
            const Mat3 body = 100.0 * axes.toRotationMatrix() *
                              (Vec3::Constant(2.0) + dice.vector()).asDiagonal() *
                              axes.toRotationMatrix().transpose();
            b.inertias.push_back({900.0, body, body.inverse()});
        }
        for (std::size_t k = 0; k <= count; ++k) {
            b.shape.push_back(0);
            b.mass.push_back(1000.0 + 500.0 * dice.unit(dice.random));
            b.inertia_row.push_back(static_cast<std::int32_t>(k) % inertias);
            b.position.push_back(dice.vector());
            b.orientation.push_back(exponential_map(3.0 * dice.vector()));
            b.momentum.push_back(1000.0 * dice.vector());
            b.angular_momentum.push_back(100.0 * angle / kStep * dice.vector());
            b.held.push_back(0);
            b.rotation.push_back(Mat3::Identity());
            b.velocity.push_back(Vec3::Zero());
            b.angular_velocity.push_back(Vec3::Zero());
            b.inverse_mass.push_back(0.0);
            b.inverse_inertia_world.push_back(Mat3::Zero());
            corrections.shift.push_back(1e-3 * dice.vector());
            corrections.turn.push_back(angle * dice.vector());
            if (dice.unit(dice.random) > 0.5) b.angular_momentum[k].setZero();
            if (dice.unit(dice.random) > 0.5) corrections.turn[k].setZero();
            update_derived(b, k);
            start.push_back(b.angular_velocity[k]);
            b.velocity[k] += dice.vector();
            if (dice.unit(dice.random) > 0.5) b.angular_velocity[k] += angle * dice.vector();
        }
    }
    Advance step() const { return {start, corrections, kStep}; }

    static constexpr double kStep = 0.01;  // [s]
};

using test::same_bits;
bool same_bits(const Bodies& a, const Bodies& b) {
    return same_bits(a.position, b.position) && same_bits(a.orientation, b.orientation) &&
           same_bits(a.momentum, b.momentum) && same_bits(a.angular_momentum, b.angular_momentum) &&
           same_bits(a.rotation, b.rotation) && same_bits(a.velocity, b.velocity) &&
           same_bits(a.angular_velocity, b.angular_velocity) &&
           same_bits(a.inverse_mass, b.inverse_mass) &&
           same_bits(a.inverse_inertia_world, b.inverse_inertia_world);
}

// Both ways of advancing these of the floes.
void check_bits(const Floes& floes, const std::vector<std::int32_t>& which) {
    Bodies expected = floes.bodies;
    reference::advance_floes(expected, which, floes.step());
    CHECK_FALSE(same_bits(expected, floes.bodies));
    test::on_every_instruction_set([&] {
        Bodies bodies = floes.bodies;
        advance_floes(bodies, which, floes.step());
        CHECK(same_bits(bodies, expected));
    });
}

}  // namespace

TEST_CASE("every instruction set advances floes to the bits of the reference",
          "[integrate][simd]") {
    // a step's angle, one that takes all terms of the series, one that is halved
    const double angle = GENERATE(0.01, 0.3, 3.0);
    const int inertias = GENERATE(1, 3);
    Dice dice{std::mt19937(static_cast<unsigned>(inertias))};
    for (std::size_t count = 1; count <= 18; ++count) {
        const Floes floes(count, inertias, angle, dice);
        std::vector<std::int32_t> all, some;
        for (std::int32_t k = 1; k <= static_cast<std::int32_t>(count); ++k) {
            all.push_back(k);
            if (k % 3 != 0) some.push_back(k);
        }
        check_bits(floes, all);
        check_bits(floes, some);
    }
}

TEST_CASE("floes without angular momentum keep their orientation bit for bit",
          "[integrate][simd]") {
    Dice dice{std::mt19937(5)};
    Floes floes(9, 1, 0.01, dice);
    for (std::size_t k = 0; k < floes.start.size(); ++k) {
        floes.bodies.angular_momentum[k].setZero();
        floes.bodies.angular_velocity[k] = floes.start[k];
        floes.corrections.turn[k].setZero();
    }
    const std::vector<std::int32_t> all{1, 2, 3, 4, 5, 6, 7, 8, 9};
    check_bits(floes, all);
    Bodies bodies = floes.bodies;
    advance_floes(bodies, all, floes.step());
    CHECK(same_bits(bodies.orientation, floes.bodies.orientation));
    CHECK(same_bits(bodies.inverse_inertia_world, floes.bodies.inverse_inertia_world));
}
