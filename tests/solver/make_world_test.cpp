// SPDX-License-Identifier: GPL-3.0-or-later
// Worlds made in code begin as asked, and move as those of case files do.
//
// Tolerances: the height's error of 1e-12 m makes a floe heave at 6e-12 m/s; 1e-9 m/s leaves a
// reserve.
#include "solver/run/make_world.hpp"

#include <catch2/catch.hpp>

#include "common/base/error.hpp"
#include "common/formats/spheres_file.hpp"
#include "solver/case/read_case.hpp"
#include "solver/record/recorder.hpp"
#include "solver/run/run.hpp"
#include "tests/support/make_sphere_sets.hpp"
#include "tests/support/temporary_file.hpp"
#include "tests/support/tolerance.hpp"
#include "tests/support/write_text.hpp"

using namespace ice;
using Catch::Contains;
using ice::test::Near;
using ice::test::tolerance;

namespace {

const SphereSet kHull = test::make_box_set({4.0, 2.0, 1.0}, 0.1, 0.2);
const SphereSet kFloe = test::make_box_set({1.0, 0.8, 0.3}, 0.05, 0.1);

Case good_case() {
    Case p;
    p.speed_table = {{0.0, 0.5}};
    return p;
}

std::string refusal(const std::function<void()>& work) {
    try {
        work();
    } catch (const Error& error) {
        CHECK(error.code() == ExitCode::bad_input);
        return error.what();
    }
    return "accepted";
}

}  // namespace

TEST_CASE("a world made in code moves bit for bit as the case file's") {
    const test::TemporaryFile hull(".spheres.h5", ""), floe(".spheres.h5", "");
    write_spheres(hull.path(), kHull);
    write_spheres(floe.path(), kFloe);
    const test::TemporaryFile file(
        ".cfg", "[simulation]\nduration = 1\ntime_step = 0.02\n[hull]\nspheres = '" +
                    hull.path().string() +
                    "'\nposition = [0, 0, 0.2]\nspeed = 0.5\n"
                    "[[floes]]\nspheres = '" +
                    floe.path().string() +
                    "'\npattern = 'single'\nposition = [2.6, 0.1, -0.1]\nvelocity = [-0.2, 0, 0]\n"
                    "angular_velocity = [0, 0, 0.3]\nhold = 'never'\n[flow]\nmodel = 'none'\n");
    World read = build_world(read_case(file.path()));

    Case p = good_case();
    p.time_step = 0.02;
    p.contact.crushing_pressure = 1e6;  // case files have it unless they say otherwise
    p.hull_position = Vec3(0.0, 0.0, 0.2);
    World made = make_world(p, read_spheres(hull.path()));
    const auto shape = add_floe_shape(made, read_spheres(floe.path()));
    CHECK(add_floe(made, shape,
                   {.position = {2.6, 0.1, -0.1},
                    .velocity = {-0.2, 0.0, 0.0},
                    .angular_velocity = {0.0, 0.0, 0.3}}) == 1);
    double force = 0.0;
    for (int k = 0; k < 50; ++k) {
        step(read);
        step(made);
        force += measure_step(made).contact_force.norm();
    }
    CHECK(force > 0.0);  // they have met
    CHECK(state_hash(made.scene, made.constraints) == state_hash(read.scene, read.constraints));
}

TEST_CASE("a floe without a height floats at rest") {
    World w = make_world(good_case(), kHull);
    FloeStart start;
    start.position.head<2>() << 20.0, 0.0;
    const std::size_t floe = add_floe(w, add_floe_shape(w, kFloe), start);
    // 0.9 of the thickness below the water: the centre at -(0.9 - 0.5) 0.3 m, to the bisection's
    // 1e-12 of the height
    CHECK(w.scene.bodies.position[floe].z() == Near(-0.12).margin(1e-12));
    for (int k = 0; k < 100; ++k) step(w);
    CHECK(w.scene.bodies.velocity[floe].norm() < tolerance(1e-9));
}

TEST_CASE("floes made in code are held and released as a case's") {
    World w = make_world(good_case(), kHull);
    const auto shape = add_floe_shape(w, kFloe);
    const auto wall = add_floe(w, shape, {.position = {2.6, 0.9, -0.1}, .hold = Hold::always});
    const auto waits =
        add_floe(w, shape, {.position = {2.6, -0.1, -0.1}, .hold = Hold::until_hull_contact});
    const auto far =
        add_floe(w, shape, {.position = {9.0, 0.0, -0.1}, .hold = Hold::until_hull_contact});
    for (int k = 0; k < 100; ++k) step(w);
    const Bodies& b = w.scene.bodies;
    CHECK(b.held[wall] == 1);
    CHECK(b.held[waits] == 0);
    CHECK(b.held[far] == 1);
    CHECK(w.parameters.floes.size() == 2);
}

TEST_CASE("a ship without a speed table is at rest") {
    Case p = good_case();
    p.speed_table.clear();
    World w = make_world(p, kHull);
    add_floe(w, add_floe_shape(w, kFloe), {.position = {9.0, 0.0, -0.12}});
    step(w);
    CHECK(w.scene.ship_velocity == Vec3::Zero());
}

TEST_CASE("what no world can be made of is refused by name") {
    Case p = good_case();
    p.time_step = 0.0;
    CHECK_THAT(refusal([&] { make_world(p, kHull); }), Contains("Case::time_step: is 0"));
    p = good_case();
    p.ice_density = std::nan("");
    CHECK_THAT(refusal([&] { make_world(p, kHull); }), Contains("Case::ice_density: is nan"));
    p = good_case();
    p.speed_table = {{0.0, 0.5}, {0.0, 0.6}};
    CHECK_THAT(refusal([&] { make_world(p, kHull); }), Contains("row 2: time does not rise"));
    p = good_case();
    p.dimension = 2;
    CHECK_THAT(refusal([&] { make_world(p, kHull); }), Contains("is a 3D set"));

    World w = make_world(good_case(), kHull);
    CHECK_THAT(refusal([&] {
                   add_floe_shape(w, test::make_box_set({1, 1, 0.3}, 0.05, 0.1, 2));
               }),
               Contains("the floe: is a 2D set"));
    CHECK_THAT(refusal([&] { add_floe(w, 1, FloeStart{}); }),
               Contains("no shape has the number 1"));
    CHECK_THAT(refusal([&] { add_floe(w, 0, FloeStart{}); }),
               Contains("no shape has the number 0"));
    w.parameters.ice_density = 1100.0;
    const auto shape = add_floe_shape(w, kFloe);
    CHECK_THAT(refusal([&] { add_floe(w, shape, FloeStart{}); }),
               Contains("no floating equilibrium"));
}
