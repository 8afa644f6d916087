// SPDX-License-Identifier: GPL-3.0-or-later
// Many contacts at once, against what the law of solve_contacts.hpp says.
//
// Law of the impact stage: v_r . n >= -e min(v_r0 . n, 0) at every touching contact, equality where
// it carries an impulse. A floe with speed u that strikes a row of n floes at rest, all touching,
// equal masses: the struck contact opens with e u; the others were at rest and push without
// opening, so the row keeps one speed v. Momentum u = (v - e u) + n v gives
//
//     v = (1 + e) u / (n + 1),    the striker keeps (1 - n e) u / (n + 1).
//
// A row that moves as one body is the answer of simultaneous impacts; Newton's cradle, where the
// last one flies off, is that of impacts one after another, which floes apart from each other get.
#include <catch2/catch.hpp>

#include "tests/support/make_worlds.hpp"
#include "tests/validation/table.hpp"

using namespace ice;

namespace {

Case exact(double restitution) {
    Case p = test::empty_space(0.01);
    p.contact.restitution = restitution;
    p.contact.friction_ice_ice = 0.3;
    p.contact.iterations = 20000;
    p.contact.tolerance = 1e-13;
    return p;
}

// Floes along x with their faces `gap` apart (negative: overlapping), the first one moving.
World row(const Case& parameters, int count, double gap, double speed) {
    World w = test::plate_world(parameters, Vec3(1, 1, 1), 0.1, 0.2, 100.0);
    const auto box = test::add_shape(w, test::make_box_set(test::kPaperFloe, 0.05, 0.1));
    for (int k = 0; k < count; ++k)
        add_floe(w.scene, box, 900.0, Vec3(k * (test::kPaperFloe.x() + gap), 0, 0),
                 Quaternion::Identity(), 0, false);
    w.scene.bodies.momentum[1] = w.scene.bodies.mass[1] * Vec3(speed, 0, 0);
    update_derived(w.scene.bodies, 1);
    return w;
}

}  // namespace

TEST_CASE("a box dropped flat leaves with e of its speed and no spin", "[validation]") {
    World w = test::plate_world(exact(0.3), Vec3(4, 4, 0.4), 0.1, 0.1, 0.0);
    const auto box = test::add_shape(w, test::make_box_set(test::kPaperFloe, 0.05, 0.1));
    add_floe(w.scene, box, 900.0, Vec3(0.013, 0.021, -0.3), Quaternion::Identity(), 0, false);
    w.scene.bodies.momentum[1] = w.scene.bodies.mass[1] * Vec3(0, 0, 1.0);
    update_derived(w.scene.bodies, 1);
    for (int k = 0; k < 40; ++k) step(w);
    // 80 contacts share the impulse; what the solver leaves of each adds up
    test::validate({"floe falling flat on a plate, e = 0.3: speed after over before", "", 0.3,
                    -w.scene.bodies.velocity[1].z(), test::within(1e-8), "e"});
    test::validate({"floe falling flat on a plate, e = 0.3: spin afterwards", "rad/s", 0.0,
                    w.scene.bodies.angular_velocity[1].norm(), test::within(1e-8), "symmetry"});
}

TEST_CASE("a touching row of five struck end-on moves as one, with (1 + e) / 6 of the speed",
          "[validation]") {
    const double e = GENERATE(0.0, 0.3, 1.0);
    World w = row(exact(e), 6, -1e-6, 1.0);
    step(w);
    const auto& v = w.scene.bodies.velocity;
    for (std::size_t k = 2; k <= 6; ++k)
        test::validate({"touching row of five floes struck end-on, " +
                            std::string("e = 0, 0.3, 1: ") +
                            "speed over (1 + e) / 6 of the striker's",
                        "", 1.0, v[k].x() / ((1.0 + e) / 6.0), test::within(1e-6),
                        "simultaneous impacts: the row does not open"});
    test::validate({"touching row of five floes struck end-on: striker's loss over (1 + e) 5 / 6",
                    "", 1.0, (1.0 - v[1].x()) / (5.0 * (1.0 + e) / 6.0), test::within(1e-6),
                    "momentum"});
}

TEST_CASE("a row of five apart from each other hands the blow on: ((1 + e) / 2)^5 at its end",
          "[validation]") {
    const double e = GENERATE(0.3, 1.0);
    World w = row(exact(e), 6, 0.0473, 1.0);
    const auto& v = w.scene.bodies.velocity;
    while (v[6].x() == 0.0 && w.time < 10.0) step(w);
    test::validate(
        {"row of five floes 47 mm apart struck end-on: first speed of the last, over "
         "((1 + e) / 2)^5 of the striker's",
         "", 1.0, v[6].x() / std::pow(0.5 * (1.0 + e), 5), test::within(1e-6),
         "impacts one after another"});
}

TEST_CASE("a stack of ten floes under a hull comes to rest, each layer carries those below",
          "[validation]") {
    // the defaults, and a solver that leaves less: what it leaves keeps the stack creeping
    const bool tight = GENERATE(false, true);
    Case p = test::empty_space(0.01);
    p.gravity = 9.81;
    p.buoyancy = BuoyancyModel::distributed;
    p.drag = DragModel::panel;
    p.contact.iterations = tight ? 300 : 30;
    p.contact.tolerance = tight ? 1e-6 : 1e-4;
    World w = test::plate_world(p, Vec3(4, 4, 0.4), 0.1, 0.1, -1.0);
    const auto box = test::add_shape(w, test::make_box_set(test::kPaperFloe, 0.05, 0.1));
    // small gaps, none exactly above the next
    for (int k = 0; k < 10; ++k)
        add_floe(w.scene, box, 900.0, Vec3(0.02 * (k % 3), 0.01 * (k % 2), -1.152 - 0.302 * k),
                 Quaternion::Identity(), 0, false);
    while (w.time < 8.0) step(w);
    std::vector<double> force(11, 0.0);  // on floe k from above [N]
    double fastest = 0.0;
    const int count = 200;
    for (int k = 0; k < count; ++k) {
        step(w);
        for (const Constraint& c : w.constraints)
            force[c.b] -= c.total_normal() * c.normal.z() / p.time_step / count;
        for (std::size_t i = 1; i <= 10; ++i)
            fastest = std::max(fastest, w.scene.bodies.velocity[i].norm());
    }
    const double net = (1000.0 - 900.0) * 9.81 * test::kPaperFloe.prod();
    for (int k = 0; k < 10; ++k)
        test::validate(
            {"stack of ten floes under a hull: force in a layer over the lift of the floes "
             "below it",
             "", 1.0, force[k + 1] / ((10 - k) * net), test::within_percent(1),
             "(10 - k) (rho_w - rho_i) g V"});
    if (tight)
        test::validate(
            {"stack of ten floes under a hull: greatest speed from 8 to 10 s, solver's "
             "tolerance 1e-6 m/s",
             "m/s", 1e-3, fastest, test::at_most_expected(), "it comes to rest"});
    else
        test::show({"stack of ten floes under a hull: greatest speed, tolerance 1e-4 m/s (default)",
                    "m/s",
                    0.0,
                    fastest,
                    {},
                    "the solver's remaining error keeps it creeping"});
}

TEST_CASE("a step whose solver did not reach its tolerance says so, with its residual",
          "[validation]") {
    // one iteration cannot share a load among 80 contacts; enough of them can
    const auto [iterations, enough] = GENERATE(std::pair(1, false), std::pair(20000, true));
    Case p = exact(0.3);
    p.contact.iterations = iterations;
    World w = test::plate_world(p, Vec3(4, 4, 0.4), 0.1, 0.1, 0.0);
    const auto box = test::add_shape(w, test::make_box_set(test::kPaperFloe, 0.05, 0.1));
    add_floe(w.scene, box, 900.0, Vec3(0.013, 0.021, -0.1505), Quaternion::Identity(), 0, false);
    w.scene.bodies.momentum[1] = w.scene.bodies.mass[1] * Vec3(0, 0, 1.0);
    update_derived(w.scene.bodies, 1);
    step(w);
    CHECK(w.impacts.converged == enough);
    CHECK((w.impacts.residual <= p.contact.tolerance) == enough);
    // a stage that gains energy is solved without rebound, too
    CHECK(w.impacts.iterations <= 2 * iterations);
    CHECK((w.impacts.iterations >= iterations) == !enough);
    // what is left shows where it should: the box does not leave flat
    CHECK((w.scene.bodies.angular_velocity[1].norm() < 1e-8) == enough);
}
