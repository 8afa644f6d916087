// SPDX-License-Identifier: GPL-3.0-or-later
// Port and starboard are treated alike.
//
// What the arithmetic allows: contacts, friction and motion commute with the mirror image bit for
// bit, because sphere sets are exactly symmetric and every order and tie in narrow/ looks at what
// mirror images have in common first. Water does not: its loads are sums over triangles in the
// mesh's order (1e-15 of a load). The motion amplifies that.
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/make_worlds.hpp"
#include "tests/validation/paper_case.hpp"
#include "tests/validation/table.hpp"

using namespace ice;

namespace {

Vec3 mirrored(const Vec3& v) { return {v.x(), -v.y(), v.z()}; }
Vec3 mirrored_turn(const Vec3& w) { return {-w.x(), w.y(), -w.z()}; }
Quaternion mirrored(const Quaternion& q) { return {q.w(), -q.x(), q.y(), -q.z()}; }

const SphereSet& hull_set() {
    FillOptions options;
    options.surface_only = true;
    static const SphereSet set = test::set_of_mesh("paper-hull-3d", options);
    return set;
}

SphereSet floe_set(Arrangement arrangement) {
    FillOptions options;
    options.radius = 0.05;
    options.arrangement = arrangement;
    return test::set_of_mesh("paper-floe-3d", options);
}

// The paper's 3D ship at its starting place, moving; floes of one shape are added.
World ship(bool water, double speed, NormalRule rule, Arrangement arrangement, Hold hold) {
    Case p = test::empty_space(0.01);
    p.normal = rule;
    p.speed_table = {{0.0, speed}};
    p.contact.iterations = 30;
    p.contact.tolerance = 1e-4;
    p.floes[0].hold = hold;
    if (water) {
        p.gravity = 9.81;
        p.buoyancy = BuoyancyModel::distributed;
    }
    World w;
    w.parameters = p;
    w.scene = make_scene(build_shape(hull_set(), false), Vec3(-9.6, 0, 0), Vec3(speed, 0, 0));
    test::add_shape(w, floe_set(arrangement));
    return w;
}

// Largest difference of the second world from the mirror image of the first, in m, N s and N m s.
double difference(const Bodies& a, const Bodies& b) {
    double worst = 0.0;
    for (std::size_t i = 1; i < a.size(); ++i) {
        const Vec3 turn = mirrored_turn(a.angular_momentum[i]) - b.angular_momentum[i];
        worst =
            std::max({worst, (mirrored(a.position[i]) - b.position[i]).norm(),
                      (mirrored(a.momentum[i]) - b.momentum[i]).norm(), turn.norm(),
                      (mirrored(a.orientation[i]).coeffs() - b.orientation[i].coeffs()).norm()});
    }
    return worst;
}

// Lateral force of the ship's contacts, and the sum of its magnitudes [N].
std::pair<double, double> lateral(const World& w) {
    double sum = 0.0, size = 0.0;
    for (const Constraint& c : w.constraints) {
        if (c.a != 0) continue;
        const double now =
            (c.total_normal() * c.normal.y() + c.total_tangent().y()) / w.parameters.time_step;
        sum += now;
        size += std::abs(now);
    }
    return {sum, size};
}

// Mean lateral force over that of one side, of a field of four columns symmetric about y = 0.
double lateral_share(bool water, double seconds) {
    World w = ship(water, 0.5, NormalRule::surface, Arrangement::lattice, Hold::until_hull_contact);
    for (const double y : {-1.35, -0.45, 0.45, 1.35})
        for (int row = 0; row < 8; ++row)
            add_floe(w.scene, 1, 900.0, Vec3(0.55 + 1.1 * row, y, -0.12), Quaternion::Identity(), 0,
                     true);
    double sum = 0.0, size = 0.0;
    while (w.time < seconds) {
        step(w);
        const auto [now, magnitude] = lateral(w);
        sum += now;
        size += magnitude;
    }
    REQUIRE(size > 100.0);
    return std::abs(sum) / (0.5 * size);
}

}  // namespace

TEST_CASE("mirror-image floes at the ship move as mirror images", "[validation][symmetry]") {
    const bool water = GENERATE(false, true);
    const NormalRule rule = GENERATE(NormalRule::surface, NormalRule::centres);
    const Arrangement arrangement = GENERATE(Arrangement::conforming, Arrangement::lattice);
    World port = ship(water, 1.0, rule, arrangement, Hold::never), starboard = port;
    for (int k = 0; k < 4; ++k) {
        const Vec3 at(1.2 * k + 0.3, 0.21 * std::sin(3.0 + k), -0.1);
        const Quaternion turn(Eigen::AngleAxisd(0.1 + 0.07 * k, Vec3(1, k - 1, 3).normalized()));
        add_floe(port.scene, 1, 900.0, at, turn, 0, false);
        add_floe(starboard.scene, 1, 900.0, mirrored(at), mirrored(turn), 0, false);
    }
    std::size_t contacts = 0;
    for (int k = 0; k < (water ? 1 : 500); ++k) {
        step(port);
        step(starboard);
        contacts += port.contacts.size();
    }
    REQUIRE(contacts > 0);
    const double off = difference(port.scene.bodies, starboard.scene.bodies);
    if (water)
        // the loads' rounding, of 10 N s per step
        test::validate(
            {"mirror-image floes at the paper's 3D ship, afloat: difference after a step", "N s",
             0.0, off, test::within(1e-13), "symmetry; to rounding of the loads"});
    else
        test::validate(
            {"mirror-image floes at the paper's 3D ship, no water: difference after 500 "
             "steps",
             "N s", 0.0, off, test::within(0.0), "symmetry; bit for bit"});
}

TEST_CASE("a field symmetric about the ship's centre plane pushes it to neither side",
          "[validation][symmetry]") {
    test::validate(
        {"symmetric field of 4 x 8 floes, no water, 4 s: mean lateral force over that of "
         "one side",
         "", 0.0, lateral_share(false, 4.0), test::within(1e-9),
         "symmetry; rounding, amplified by the motion"});
    // later floes lie beside each other, of which the one with the smaller number is body a
    test::show(
        {"symmetric field of 4 x 8 floes, no water, 16 s: mean lateral force over that of "
         "one side",
         "",
         0.0,
         lateral_share(false, 16.0),
         {},
         "edges that lie on each other: either may be the one that touches"});
    // roundings of the loads, amplified where edges on edges change over
    test::validate(
        {"symmetric field of 4 x 8 floes, afloat, 2 s: mean lateral force over that of "
         "one side",
         "", 0.0, lateral_share(true, 2.0), test::within(1e-4),
         "symmetry; rounding of the loads, amplified by the motion"});
    test::show(
        {"symmetric field of 4 x 8 floes, afloat, 16 s: mean lateral force over that of one "
         "side",
         "",
         0.0,
         lateral_share(true, 16.0),
         {},
         "chaotic motion has amplified the rounding"});
}
