// SPDX-License-Identifier: GPL-3.0-or-later
// Ice that is held for good moves for the ship by crushing alone.
//
// Tolerances: 1e-6 is a normal stored as a float.
#include <catch2/catch.hpp>
#include <cmath>

#include "common/base/units.hpp"
#include "solver/run/measure_imbalance.hpp"
#include "tests/support/make_worlds.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;
using ice::test::tolerance;

namespace {

constexpr double kPressure = 2e5;  // [Pa]
constexpr double kFriction = 0.1;
const Vec3 kHull(0.4, 4.0, 2.0);

// The set with its axes turned.
SphereSet turned(SphereSet set, const Mat3& turn) {
    for (Vec3& v : set.centers) v = turn * v;
    for (Vec3& v : set.normals) v = turn * v;
    for (CreaseNormal& c : set.creases) c.normal = turn * c.normal;
    for (Vec3& v : set.mesh.vertices) v = turn * v;
    set.solid = measure_mass(set.mesh);
    return set;
}

// A wide plate whose front leans over the ice by `rake`, `ahead` of a held floe along x; it moves
// along x as the table says.
World world_with_held_floe(double rake, double ahead,
                           std::vector<std::pair<double, double>> speeds) {
    Case p = test::empty_space(0.01);
    p.contact.crushing_pressure = kPressure;
    p.contact.friction_ship_ice = kFriction;
    p.floes[0].hold = Hold::always;
    p.speed_table = std::move(speeds);
    World w;
    w.parameters = p;
    const Mat3 turn = Eigen::AngleAxisd(rake, Vec3::UnitY()).toRotationMatrix();
    // along x from the plate's middle to its front, at the height of the floe's first corner
    const double front =
        0.5 * kHull.x() / std::cos(rake) + 0.5 * test::kPaperFloe.z() * std::tan(rake);
    w.scene = make_scene(build_shape(turned(test::make_box_set(kHull, 0.1, 0.2), turn), false),
                         Vec3(-0.5 * test::kPaperFloe.x() - front - ahead, 0, 0),
                         Vec3(p.ship_speed(0.0), 0, 0));
    const auto shape = test::add_shape(w, test::make_box_set(test::kPaperFloe, 0.05, 0.1));
    add_floe(w.scene, shape, 900.0, Vec3::Zero(), Quaternion::Identity(), 0, true);
    return w;
}

void advance_balanced(World& w) {
    const Momenta before = momenta_of(w);
    step(w);
    REQUIRE_NOTHROW(require_balance(before, w));
}

}  // namespace

TEST_CASE("a ship driven into held ice loses its work to crushing and friction, nothing else",
          "[step][crushing][energy]") {
    const double rake = kDegree * GENERATE(0.0, 20.0, 40.0);
    const bool speeds_up = GENERATE(false, true);
    CAPTURE(rake / kDegree, speeds_up);
    World w = world_with_held_floe(rake, 0.011, {{0.0, 0.5}, {1.0, speeds_up ? 1.0 : 0.5}});
    for (int k = 0; k < 60; ++k) advance_balanced(w);
    const EnergyLedger& ledger = w.ledger;
    REQUIRE(ledger.crushing > 0.0);
    CHECK(ledger.restitution == 0.0);
    CHECK(ledger.kinetic_change == 0.0);
    // sums of up to 60 steps with a hundred contacts each, of one sign, each exact to 1e-16
    CHECK(ledger.crushing + ledger.friction == Near(ledger.ship_work).epsilon(1e-12));
    CHECK(std::abs(ledger.residual(*ledger.potential_start)) <=
          tolerance(1e-12) * ledger.ship_work);
    // pressed along the front's normal, sliding along its slope: v sin against v cos
    CHECK(ledger.friction ==
          Near(kFriction * std::tan(rake) * ledger.crushing).margin(1e-6 * ledger.crushing));
    CHECK(w.scene.bodies.position[1] == Vec3::Zero());
}

TEST_CASE("a plate driven right through a held floe has cut all of it", "[step][crushing]") {
    World w = world_with_held_floe(0.0, 0.011, {{0.0, 0.5}});
    const double through =
        test::kPaperFloe.x() + kHull.x() + 0.1;  // travel until it is out at the far side
    double first = 0.0, peak = 0.0;
    while (w.time * 0.5 < through) {
        advance_balanced(w);
        const auto [normal, tangent] = test::ship_on_ice(w);
        peak = std::max(peak, normal.norm());
        if (first == 0.0) first = peak;
        if (w.time * 0.5 < test::kPaperFloe.x() + 0.05) continue;
        // the front has left the ice behind
        REQUIRE(normal == Vec3::Zero());
        REQUIRE(tangent == Vec3::Zero());
    }
    const double section = test::kPaperFloe.y() * test::kPaperFloe.z();
    // normals are floats: a flat wing of an edge may lean by 1e-7, against a touch of 1e-4 m
    CHECK(first == Near(kPressure * section).epsilon(1e-3));
    // the sides stand upright: nothing of them counts, however far the front has come. The last
    // rows of edges that slide out at the far side lean by rounding.
    CHECK(peak <= 1.02 * kPressure * section);
    // spheres are gone as soon as their centres are, a radius early
    CHECK(w.ledger.ship_work == Near(kPressure * section * test::kPaperFloe.x()).epsilon(0.06));
    CHECK(w.ledger.crushing == Near(w.ledger.ship_work).epsilon(1e-12));
}
