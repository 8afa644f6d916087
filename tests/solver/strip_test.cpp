// SPDX-License-Identifier: GPL-3.0-or-later
// Level ice in 2D: the load and the length of a strip, against a beam's on water.
//
// Tolerances: 0.05 and 0.005 are half of a last printed digit; 1e-3 of a load is the constant 0.680
// of (28), cut to three digits, or what one step adds; 1e-6 is a normal stored as a float; 1e-9 is
// ends on whole multiples of 2^-30 m.
#include "solver/live_edge/strip.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "common/base/units.hpp"
#include "solver/bending/breaking_load.hpp"
#include "solver/run/measure_imbalance.hpp"
#include "tests/support/make_strips.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using namespace ice::test;

namespace {

// Ice 1 m thick as in the table of published values: it breaks 15.85 m from its tip under 12.8
// kN/m.
Case thick_case(double speed, double dt) {
    Case p;
    p.dimension = 2;
    p.time_step = dt;
    p.duration = 1e6;
    p.speed_table = {{0.0, speed}};
    p.contact.restitution = 0.1;
    p.contact.friction_ship_ice = 0.1;
    p.contact.crushing_pressure = 1e6;
    p.level_ice.thickness = 1.0;
    p.level_ice.extent = {0.0, 200.0, 0.0, 0.0};
    p.level_ice.spacing = 0.2;
    p.level_ice.scatter = 0.0;
    return p;
}

// A ship whose stem is 1 mm clear of ice 1 m thick at its upper face.
World stem_at_ice(const Case& p, double slope) {
    const double top = (1.0 - p.ice_density / p.water_density) * p.level_ice.thickness;
    Case clear = p;
    clear.hull_position = Vec3(-1e-3, 0, 0);
    return strip_world(clear, straight_stem(slope, 3.0, top, 10.0, 0.3, 0.3));
}

// p A of the last step [N/m].
double crushing_force(const World& w) {
    double sum = 0.0;
    for (const Constraint& c : w.constraints)
        if (c.a == 0 && c.total_normal() > 0.0) sum += c.max_impulse / w.parameters.time_step;
    return sum;
}

}  // namespace

TEST_CASE("a strip bears a beam's load and breaks at a beam's length",
          "[level_ice][strip][analytic]") {
    Case p = thick_case(0.1, 0.01);
    p.water_density = 1025.0;
    // h [m], E [Pa], load [kN/m], length [m] at 0.5 MPa
    const auto [thickness, modulus, load, length] = GENERATE(table<double, double, double, double>(
        {{1.0, 5e9, 12.8, 15.85}, {1.0, 2e9, 16.1, 12.60}, {0.5, 5e9, 5.4, 9.42}}));
    p.bending.elastic_modulus = modulus;
    const IcePlate plate = plate_of(thickness, p);
    const double weight = 1025.0 * 9.81;
    const double closed = 0.680 * 5e5 * std::pow(weight * std::pow(thickness, 5) / modulus, 0.25);
    CHECK(breaking_load(0.0, thickness, p) == Near(closed).epsilon(1e-3));
    CHECK(1e-3 * breaking_load(0.0, thickness, p) == Near(load).margin(0.05));
    CHECK(beam_breaking_length(plate) == Near(length).margin(0.005));
    // the largest moment of the beam under a load at its end, by its slope on both sides
    const double lambda = std::pow(3.0 * weight / (modulus * std::pow(thickness, 3)), 0.25);
    const auto moment = [&](double x) { return std::exp(-lambda * x) * std::sin(lambda * x); };
    const double at = beam_breaking_length(plate), beside = 1e-3 * at;
    CHECK(moment(at) > moment(at - beside));
    CHECK(moment(at) > moment(at + beside));
    // ... which is the strength there
    CHECK(breaking_load(0.0, thickness, p) / lambda * moment(at) ==
          Near(5e5 * thickness * thickness / 6.0).epsilon(1e-12));
}

TEST_CASE("a strip breaks in the step in which the stem's load reaches the beam's",
          "[level_ice][strip][step][analytic]") {
    const double slope = kDegree * GENERATE(30.0, 60.0);
    CAPTURE(slope / kDegree);
    const Case p = thick_case(1e-3, 0.01);
    World w = stem_at_ice(p, slope);
    const double bears = breaking_load(0.0, 1.0, p);
    const double down_share = std::cos(slope) - 0.1 * std::sin(slope);
    double before = 0.0, now = 0.0;
    while (w.edge.broken() == 0) {
        REQUIRE(now < bears);
        before = now;
        const Momenta momenta = momenta_of(w);
        step(w);
        REQUIRE(w.time < 60.0);
        if (w.edge.broken() > 0) break;
        REQUIRE_NOTHROW(require_balance(momenta, w));
        now = crushing_force(w) * down_share;
        const auto [normal, tangent] = ship_on_ice(w);
        REQUIRE(-normal.z() - tangent.z() == Near(now).epsilon(1e-6).margin(1e-6));
        if (now < bears) continue;
        // the load is reached: free from the next step on
        CHECK(before > (1.0 - tolerance(1e-3)) * bears);
        CHECK(now < (1.0 + tolerance(1e-3)) * bears);
        // a straight edge cut by a slope: A = depth / cos; faces 0.1 mm apart count as touching
        const double depth = bears * std::cos(slope) / (1e6 * down_share);
        CHECK(w.time * 1e-3 - 1e-3 - 0.5 * p.level_ice.gap == Near(depth).margin(2e-4));
        step(w);
        REQUIRE(w.edge.broken() == 1);
        break;
    }
    REQUIRE(w.edge.broken() == 1);
    const IcePiece piece = w.edge.pieces()[0];
    CHECK(piece.load == Near(now).epsilon(1e-6));
    const double length = beam_breaking_length(plate_of(1.0, p));
    CHECK(piece.radius == Near(length).epsilon(1e-12));
    CHECK(w.edge.sheet().area() == Near(200.0 - length).epsilon(1e-9));
    CHECK(tip_of(w.edge.sheet()) == Near(length).epsilon(1e-9));
}

TEST_CASE("a steep stem crushes a strip and never bends it", "[level_ice][strip][step][analytic]") {
    const double slope = kDegree * 80.0, friction = 0.2;  // tan(slope) > 1 / friction
    Case p = thick_case(0.1, 0.02);
    p.contact.friction_ship_ice = friction;
    p.level_ice.spacing = 0.05;
    World w = stem_at_ice(p, slope);
    double force = 0.0;
    std::int64_t steps = 0;
    while (w.time < 40.0) {  // 4 m
        step(w);
        REQUIRE(std::abs(sum_of(w.edge.areas()) - 200.0) <= tolerance(1e-9) * 200.0);
        if (w.time < 10.0) continue;
        const auto [normal, tangent] = ship_on_ice(w);
        force += normal.x() + tangent.x();
        ++steps;
    }
    CHECK(w.edge.broken() == 0);
    // the stem's foot is where the ice is gone, to what the sheet keeps of crushed ice
    CHECK(w.edge.areas().crushed == Near(4.0 - 0.1 - 0.25).margin(0.3));
    // the whole thickness is crushed at a time, but for the wing of the lower corner's disc, which
    // leans away from the stem; that of the upper one is on the deck as well
    const double mean = force / static_cast<double>(steps), wing = 0.05 + 0.5 * 0.05;
    const double lean = std::sin(slope) + friction * std::cos(slope);
    const double met = (1.0 - wing) * std::sin(slope) + wing * std::cos(slope);
    CHECK(mean == Near(1e6 * met * lean).epsilon(2e-3));
    CHECK(mean == Near(1e6 / std::sin(slope) * lean).epsilon(0.1));  // 9 %: the wing
}

TEST_CASE("tiles and windows of a strip are its tip's", "[level_ice][strip]") {
    IceSheet sheet(strip_extent(0.0, 50.0), 0.5);
    const auto tile = [&] { return strip_tiles(sheet, 0.0, 4.0); };
    REQUIRE(tile().size() == 1);
    CHECK(tile()[0] == loop_of(strip_extent(0.0, 12.0)));
    sheet.take(loop_of({Vec2(-1, -1), Vec2(3.5, 1)}));
    CHECK(tile()[0] == loop_of(strip_extent(3.5, 12.0)));
    sheet.take(loop_of({Vec2(-1, -1), Vec2(41.0, 1)}));
    CHECK(tile()[0] == loop_of(strip_extent(41.0, 50.0)));
    sheet.take(loop_of({Vec2(-1, -1), Vec2(51.0, 1)}));
    CHECK(tile().empty());
    CHECK(std::isinf(tip_of(sheet)));
    const Vec2 push(1.0, 0.0);
    const std::vector<EdgeLoad> loads{{{3.0, 0}, 3.0, 1.0, 1.0, push},
                                      {{4.0, 0}, -1.0, 1.0, 1.0, push},
                                      {{9.0, 0}, 7.0, 1.0, 1.0, push}};
    const auto windows = tip_window(loads, 3.0, 4.0);
    REQUIRE(windows.size() == 1);
    CHECK(windows[0].down == 2.0);
    CHECK(windows[0].at == Vec2(3.0, 0.0));
    CHECK(tip_window({loads[1]}, 3.0, 4.0).empty());
    CHECK(strip_bodies(loop_of(strip_extent(1.0, 2.0)), 0.1, 0.95).empty());
    CHECK(strip_length(strip_bodies(loop_of(strip_extent(1.0, 2.0)), 0.1, 0.5)[0]) == Near(0.9));
}
