// SPDX-License-Identifier: GPL-3.0-or-later
// A plate driven into ice that cannot move: the force is the crushing pressure on the section cut,
// whatever spheres stand for the ice.
#include <catch2/catch.hpp>
#include <cmath>

#include "common/base/units.hpp"
#include "tests/support/make_filled_sets.hpp"
#include "tests/support/make_worlds.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;

namespace {

constexpr double kPressure = 2e5;  // [Pa]

struct Driven {
    double work = 0.0, force = 0.0;  // of the ship [J], at the last step [N]
};

// A plate goes along x at `speed` into a held floe turned by `heading` about the vertical, until
// the floe's foremost edge is `depth` inside.
Driven drive(double heading, double radius, double depth, double dt, double speed) {
    Case p = test::empty_space(dt);
    p.contact.crushing_pressure = kPressure;
    p.contact.friction_ship_ice = 0.0;
    p.speed_table = {{0.0, speed}};
    p.floes[0].hold = Hold::always;
    World w;
    w.parameters = p;
    const Quaternion turn(Eigen::AngleAxisd(heading, Vec3::UnitZ()));
    const double reach = 0.5 * (test::kPaperFloe.x() * std::abs(std::cos(heading)) +
                                test::kPaperFloe.y() * std::abs(std::sin(heading)));
    w.scene = make_scene(build_shape(test::fill_box(Vec3(0.4, 4, 1), 0.1, 0.1), false),
                         Vec3(-reach - 0.2, 0, 0), Vec3(speed, 0, 0));
    const auto shape = test::add_shape(w, test::fill_box(test::kPaperFloe, radius, radius));
    add_floe(w.scene, shape, 900.0, Vec3(0, 0, 0.02), turn, 0, true);
    Driven out;
    while (w.time * speed < depth - 1e-9) {
        step(w);
        out.force = test::ship_on_ice(w).first.x();
        out.work += out.force * speed * dt;
    }
    return out;
}

}  // namespace

TEST_CASE("a plate driven against a face meets the pressure times the face",
          "[validation][crushing]") {
    const double radius = GENERATE(0.1, 0.05, 0.025);
    const Driven got = drive(0.0, radius, 0.02, 0.001, 0.5);
    CAPTURE(radius);
    // 0.8 m x 0.3 m at once; an edge's or corner's share counts in equal parts for its faces, which
    // is true to half a spacing around the face: most where two rows of 0.1 m spheres make the face
    CHECK(got.force == Near(kPressure * 0.8 * 0.3).epsilon(radius > 0.05 ? 0.05 : 0.01));
}

TEST_CASE("a plate driven against an edge meets the pressure times the section of the wedge",
          "[validation][crushing]") {
    const double radius = GENERATE(0.1, 0.05, 0.025);
    const double heading = kDegree * GENERATE(20.0, 45.0);
    const double dt = GENERATE(0.01, 0.0025);
    // the section is depth (cot + tan) wide and 0.3 m high
    const double width = 1.0 / std::tan(heading) + std::tan(heading);
    const double depth = 0.1;
    const Driven got = drive(heading, radius, depth, dt, 0.5);
    CAPTURE(radius, heading / kDegree, dt);
    // the edge is cut sphere by sphere: half a row of patches of side `radius` may be missing or
    // too much, on each of the two faces
    const double row = radius * (std::cos(heading) + std::sin(heading)) / 2.0;
    CHECK(got.force == Near(kPressure * 0.3 * depth * width).margin(kPressure * 0.3 * row));
    // work is the pressure times the volume cut: rows even out over the way. With 0.1 m spheres the
    // whole edge of 0.3 m is two corners, whose third face counts as crushed like the others:
    // 30 % too much.
    const double work = kPressure * 0.3 * 0.5 * depth * depth * width;
    CHECK(got.work == Near(work).epsilon(radius > 0.05 ? 0.31 : 0.1));
}
