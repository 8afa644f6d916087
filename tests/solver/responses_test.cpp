// SPDX-License-Identifier: GPL-3.0-or-later
// What contacts respond to impulses: by the bodies' own equations, and bits on every instruction
// set.
//
// Tolerances: 1e-15 is rounding of one sum of three terms.
#include "solver/contact/responses.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <iterator>
#include <numbers>
#include <random>
#include <vector>

#include "tests/support/contact_problem.hpp"
#include "tests/support/dice.hpp"
#include "tests/support/every_instruction_set.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;
using ice::test::tolerance;

namespace {

// Sums of a few products, of which some cancel.
constexpr double kRounding = 1e-12;

// What an impulse on b, and its opposite on a, change v_r by: by the equations of each body.
Vec3 change_of(const Bodies& bodies, std::size_t a, std::size_t b, const Vec3& arm_a,
               const Vec3& arm_b, const Vec3& impulse) {
    const auto at = [&](std::size_t body, const Vec3& arm) -> Vec3 {
        const Vec3 spin = bodies.inverse_inertia_world[body] * arm.cross(impulse);
        return bodies.response(body, impulse) + spin.cross(arm);
    };
    return at(a, arm_a) + at(b, arm_b);
}

struct Block {
    PairBlock pairs;
    PairExcess excess;
    BlockInverseInertias inverse_inertias;
    std::vector<ContactRow> rows;
};

// Of `pairs` pairs, of which the later ones have fewer contacts.
Block random_block(std::size_t pairs, std::size_t rows, unsigned seed) {
    test::Dice dice{std::mt19937(seed)};
    Block out;
    out.rows.resize(rows);
    out.pairs.rows = static_cast<std::int32_t>(rows);
    for (std::size_t lane = 0; lane < pairs; ++lane) {
        out.pairs.inverse_mass_a.v[lane] = lane % 3 == 0 ? 0.0 : 2.0 + dice.number();
        out.pairs.inverse_mass_b.v[lane] = 2.0 + dice.number();
        for (std::size_t k = 0; k < 6; ++k) {
            out.excess.a[k].v[lane] = lane % 3 == 0 ? 0.0 : 0.1 * dice.number() - (k < 3 ? 0.5 : 0);
            out.excess.b[k].v[lane] = 0.1 * dice.number() - (k < 3 ? 0.5 : 0);
        }
        for (std::size_t k = 0; k < 9; ++k) {
            const double main = k % 4 == 0 ? 2.0 : 0.0;
            out.inverse_inertias.a[k].v[lane] = lane % 3 == 0 ? 0.0 : main + 0.3 * dice.number();
            out.inverse_inertias.b[k].v[lane] = main + 0.3 * dice.number();
        }
        for (std::size_t r = 0; r < rows - lane * rows / kLanes; ++r) {
            // the normals of boxes, too, which are least along more than one axis
            const Vec3 normals[] = {dice.vector().normalized(),
                                    -Vec3::UnitX(),
                                    Vec3::UnitY(),
                                    Vec3(0.6, -0.0, 0.8),
                                    Vec3(1, -1, 0).normalized(),
                                    Vec3(1, 1, 1).normalized(),
                                    -Vec3::UnitZ()};
            const Vec3 normal = normals[(lane + 3 * r) % std::size(normals)];
            const Vec3 arm_a = dice.vector(), arm_b = dice.vector();
            for (std::size_t d = 0; d < 3; ++d) {
                const auto axis = static_cast<Eigen::Index>(d);
                out.rows[r].normal[d].v[lane] = normal[axis];
                out.rows[r].arm_a[d].v[lane] = arm_a[axis];
                out.rows[r].arm_b[d].v[lane] = arm_b[axis];
            }
        }
    }
    return out;
}

}  // namespace

TEST_CASE(
    "a unit impulse changes the velocity at a contact by its response, as the bodies' "
    "equations say",
    "[contact][analytic]") {
    const test::ContactProblem problem(40, 5, 11, GENERATE(false, true));
    const ContactRows& contacts = problem.contacts;
    const auto body = [&](std::int32_t local) {
        return static_cast<std::size_t>(contacts.bodies()[static_cast<std::size_t>(local)]);
    };
    std::size_t seen = 0;
    for (const PairBlock& block : contacts.blocks)
        for (std::int32_t r = 0; r < block.rows; ++r) {
            const ContactRow& row = contacts.rows[static_cast<std::size_t>(block.first_row + r)];
            for (std::size_t lane = 0; lane < kLanes; ++lane) {
                const Vec3 n = get(row.normal, lane);
                if (n.isZero()) {
                    CHECK(row.effective_mass.v[lane] == 0.0);
                    CHECK(row.tangent_inverse_effective_mass.v[lane] == 0.0);
                    continue;
                }
                ++seen;
                const auto change = [&](const Vec3& impulse) {
                    return change_of(problem.bodies, body(block.a[lane]), body(block.b[lane]),
                                     get(row.arm_a, lane), get(row.arm_b, lane), impulse);
                };
                const Vec3 expected = change(n);
                CHECK((get(row.response, lane) - expected).norm() <=
                      tolerance(kRounding) * expected.norm());
                const double normal = row.inverse_effective_mass.v[lane];
                CHECK(normal == Near(n.dot(expected)).epsilon(kRounding));
                CHECK(row.effective_mass.v[lane] * normal == Near(1.0).epsilon(kRounding));
                // k(t) goes as cos 2 phi round the normal: none of 64 tangents has more, and the
                // best of them lacks at most 1 - cos(pi / 64) of half of it
                const Vec3 s = n.unitOrthogonal(), t = n.cross(s);
                double most = 0.0;
                for (int k = 0; k < 64; ++k) {
                    const double angle = std::numbers::pi * k / 64.0;
                    const Vec3 tangent = std::cos(angle) * s + std::sin(angle) * t;
                    most = std::max(most, tangent.dot(change(tangent)));
                }
                const double tangent = row.tangent_inverse_effective_mass.v[lane];
                CHECK(most <= tangent * (1.0 + tolerance(kRounding)));
                CHECK(most >= tangent * (1.0 - 0.5 * (1.0 - std::cos(std::numbers::pi / 64.0))));
                CHECK(row.tangent_effective_mass.v[lane] * tangent == Near(1.0).epsilon(kRounding));
            }
        }
    CHECK(seen > 40);
}

TEST_CASE("a contact with a body that nothing moves responds by the other's mass alone",
          "[contact][analytic]") {
    // through the middle of a body of 1/3 kg, so that it does not turn; the other is held
    Block block = random_block(0, 1, 1);
    block.pairs.inverse_mass_b.v[2] = 3.0;
    for (const std::size_t k : {0u, 4u, 8u}) block.inverse_inertias.b[k].v[2] = 5.0;
    block.rows[0].normal[1].v[2] = 1.0;
    block.rows[0].arm_b[1].v[2] = -0.2;
    measure_responses(block.pairs, block.inverse_inertias, block.rows);
    CHECK(get(block.rows[0].response, 2) == Vec3(0, 3, 0));
    CHECK(block.rows[0].inverse_effective_mass.v[2] == Near(3.0).epsilon(1e-15));
    // along the surface it turns as well: 1/m + r^2 / I
    CHECK(block.rows[0].tangent_inverse_effective_mass.v[2] ==
          Near(3.0 + 0.04 * 5.0).epsilon(1e-15));
    CHECK(block.rows[0].inverse_effective_mass.v[1] == 0.0);
}

TEST_CASE("every instruction set measures the responses of the reference, bit for bit",
          "[contact][simd]") {
    const std::size_t pairs = GENERATE(0u, 1u, 2u, 3u, 4u, 5u, 7u, 8u);
    const std::size_t rows = GENERATE(0u, 1u, 2u, 9u);
    const Block given = random_block(pairs, rows, static_cast<unsigned>(10 * pairs + rows));
    const PairExcess* excess = GENERATE(false, true) ? &given.excess : nullptr;
    std::vector<ContactRow> expected = given.rows;
    reference::measure_responses(given.pairs, given.inverse_inertias, expected, excess);
    test::on_every_instruction_set([&] {
        std::vector<ContactRow> found = given.rows;
        measure_responses(given.pairs, given.inverse_inertias, found, excess);
        CHECK((rows == 0 ||
               std::memcmp(found.data(), expected.data(), rows * sizeof(ContactRow)) == 0));
    });
}
