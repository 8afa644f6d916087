// SPDX-License-Identifier: GPL-3.0-or-later
// Between spheres up to kWidestSpacing apart there is no way into a body.
//
// Tolerances: 1e-12 is rounding of a few dozen products of lengths of a metre, 1e-16 m each.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "common/formats/widest_spacing.hpp"
#include "solver/narrow/find_contacts.hpp"
#include "tests/support/make_worlds.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using namespace ice::test;

TEST_CASE("an upright edge that cuts a plate's side anywhere has a contact as deep as it is",
          "[narrow][analytic]") {
    constexpr double kRadius = 0.05, kDepth = 0.004;  // [m]
    const double thickness = GENERATE(2.2, 2.6, 3.2, 4.0, 6.0) * kRadius;
    const double spacing = GENERATE(1.0, 2.0, 2.5, kWidestSpacing) * kRadius;
    World w = plate_world(empty_space(0.01), Vec3(4, 2, 1), 0.1, 0.2, 10.0);
    const auto row = add_shape(w, make_box_set(Vec3(1.0, 0.85, thickness), kRadius, spacing));
    add_floe(w.scene, row, 900.0, Vec3::Zero(), Quaternion::Identity(), 0, false);
    // corner first: from the centre to the upright edge at (0.5, 0.425), turned onto -x
    const double turn = std::numbers::pi - std::atan2(0.425, 0.5);
    const Quaternion turned(Eigen::AngleAxisd(turn, Vec3::UnitZ()));
    const std::size_t other = add_floe(w.scene, row, 900.0, Vec3::Zero(), turned, 0, false);
    const double tip = 0.5 + std::hypot(0.5, 0.425) - kDepth;
    std::vector<Contact> contacts;
    for (const double height : {0.02, 0.1, 0.35, 0.6})  // of the plate's thickness
        for (double y = -0.41; y < 0.415; y += 0.01) {
            w.scene.bodies.position[other] = Vec3(tip, y, height * thickness);
            contacts.clear();
            ContactFinder().find(w.scene, {{1, 2}}, NormalRule::surface, 0.0, 0.0, contacts);
            CAPTURE(thickness, spacing, height, y);
            REQUIRE_FALSE(contacts.empty());
            const auto deepest =
                std::min_element(contacts.begin(), contacts.end(),
                                 [](const Contact& l, const Contact& r) { return l.gap < r.gap; });
            CHECK(deepest->gap == Near(-kDepth).margin(1e-12));
            CHECK(deepest->normal.x() == Near(1.0).margin(1e-12));
        }
}
