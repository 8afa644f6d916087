// SPDX-License-Identifier: GPL-3.0-or-later
// Loads on floes in lanes: bits on every instruction set, whatever floes lie beside each other.
//
// Tolerances: 1e-12 is rounding of sums over the floe's triangles, 1e-16 of the largest term each.
#include "solver/loads/load_floes.hpp"

#include <catch2/catch.hpp>
#include <random>

#include "tests/support/dice.hpp"
#include "tests/support/every_instruction_set.hpp"
#include "tests/support/make_meshes.hpp"
#include "tests/support/make_worlds.hpp"
#include "tests/support/same_bits.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using ice::test::Near;
using test::same_bits;

namespace {

using test::Dice;

Quaternion turn(Dice& dice) {
    return Quaternion(dice.number(), dice.number(), dice.number(), dice.number()).normalized();
}

// Floes in the water, wholly under it, above it and far from it both ways; some at rest.
World make_floes(const Case& p, std::size_t count, std::size_t shapes, Dice& dice) {
    World w = test::plate_world(p, Vec3(1, 1, 1), 0.1, 0.2, 100.0);
    const std::vector<Vec3> sizes{{1.0, 0.8, 0.3}, {0.5, 0.9, 0.4}};
    std::vector<std::int32_t> shape;
    for (std::size_t k = 0; k < shapes; ++k)
        shape.push_back(test::add_shape(w, test::make_box_set(sizes[k], 0.05, 0.1)));
    Bodies& b = w.scene.bodies;
    for (std::size_t k = 0; k < count; ++k) {
        const double height = (k % 8 == 7 ? 2.0 : 0.4) * dice.number();
        const bool upright = k % 5 == 4;
        // runs of one shape of up to three floes
        const std::size_t i =
            add_floe(w.scene, shape[k / 3 % shapes], 900.0, Vec3(3.0 * double(k), 0.0, height),
                     upright ? Quaternion::Identity() : turn(dice), 0, false);
        if (k % 4 != 3) b.velocity[i] = dice.vector();
        if (k % 3 != 2) b.angular_velocity[i] = dice.vector();
    }
    return w;
}

void check_bits(const World& w, const std::vector<std::int32_t>& floes) {
    std::vector<FloeLoad> expected(floes.size());
    reference::load_floes(w.scene, w.parameters, floes, expected);
    test::on_every_instruction_set([&] {
        std::vector<FloeLoad> loads(floes.size());
        load_floes(w.scene, w.parameters, floes, loads);
        CHECK(same_bits(loads, expected));
    });
}

}  // namespace

TEST_CASE("every instruction set loads floes to the bits of the reference",
          "[loads][water][simd]") {
    Case p = test::empty_space(0.01);
    p.gravity = 9.81;
    p.drag_coefficient = 1.0;
    p.drag = GENERATE(DragModel::none, DragModel::projected, DragModel::panel);
    p.buoyancy = GENERATE(BuoyancyModel::none, BuoyancyModel::centre, BuoyancyModel::distributed);
    // in the longer step drag would stop most of them
    p.time_step = GENERATE(0.01, 10.0);
    const std::size_t shapes = GENERATE(1u, 2u);
    Dice dice{std::mt19937(7)};
    for (std::size_t count = 1; count <= 18; ++count) {
        World w = make_floes(p, count, shapes, dice);
        w.scene.dimension = count % 6 == 5 ? 2 : 3;
        std::vector<std::int32_t> all, some;
        for (std::int32_t k = 1; k <= static_cast<std::int32_t>(count); ++k) {
            all.push_back(k);
            if (k % 7 != 3) some.push_back(k);
        }
        check_bits(w, all);
        check_bits(w, some);
    }
}

TEST_CASE(
    "drag turns a floe that moves without turning: the wetted front face's load times its arm",
    "[loads][water][analytic]") {
    Case p = test::empty_space(0.01);
    p.drag = DragModel::panel;
    p.drag_coefficient = 1.0;
    p.buoyancy = BuoyancyModel::none;
    World w = test::plate_world(p, Vec3(1, 1, 1), 0.1, 0.2, 100.0);
    const Vec3 size(1.0, 0.8, 0.3);
    const std::int32_t shape = test::add_shape(w, test::make_box_set(size, 0.05, 0.1));
    const double height = -0.05, draught = 0.5 * size.z() - height, speed = 0.5;
    const std::size_t i =
        add_floe(w.scene, shape, 900.0, Vec3(3.0, 0.0, height), Quaternion::Identity(), 0, false);
    w.scene.bodies.velocity[i] = Vec3(speed, 0.0, 0.0);
    const std::vector<std::int32_t> floes{static_cast<std::int32_t>(i)};
    std::vector<FloeLoad> loads(1);
    load_floes(w.scene, w.parameters, floes, loads);
    const double force = -0.5 * p.water_density * speed * speed * size.y() * draught;
    CHECK(loads[0].force.x() == Near(force).epsilon(1e-12));
    CHECK(loads[0].moment.y() == Near(force * (-0.5 * draught - height)).epsilon(1e-12));
    check_bits(w, floes);
}

TEST_CASE("floes all above, all under or all level with the water have the reference's bits",
          "[loads][water][simd]") {
    Case p = test::empty_space(0.01);
    p.gravity = 9.81;
    p.drag_coefficient = 1.0;
    p.drag = GENERATE(DragModel::projected, DragModel::panel);
    p.buoyancy = BuoyancyModel::distributed;
    const double height = GENERATE(5.0, 0.2, 0.15, 0.0, -0.15, -0.2, -5.0);
    Dice dice{std::mt19937(8)};
    World w = make_floes(p, 8, 1, dice);
    Bodies& b = w.scene.bodies;
    for (std::size_t i = 1; i < b.size(); ++i) {
        b.position[i].z() = height;
        b.orientation[i] = Quaternion::Identity();
        update_derived(b, i);
        b.velocity[i] = dice.vector();
    }
    check_bits(w, b.moving);
}

TEST_CASE("shapes of many corners, the last block of facets not full, have the reference's bits",
          "[loads][water][simd]") {
    // more corners than are asked for their height once, and two facets more than fill blocks
    SphereSet set = test::make_ball_set(0.4);
    set.mesh = test::make_globe(0.4, 7);
    const auto [i, j, k] = set.mesh.triangles.front();
    const auto middle = static_cast<std::int32_t>(set.mesh.vertices.size());
    set.mesh.vertices.push_back(
        (set.mesh.vertices[i] + set.mesh.vertices[j] + set.mesh.vertices[k]) / 3.0);
    set.mesh.triangles.front() = {i, j, middle};
    set.mesh.triangles.push_back({j, k, middle});
    set.mesh.triangles.push_back({k, i, middle});
    REQUIRE(set.mesh.vertices.size() > 64);
    REQUIRE(set.mesh.triangles.size() % 8 == 2);
    set.mesh.region.resize(set.mesh.triangles.size(), 0);
    Case p = test::empty_space(0.01);
    p.gravity = 9.81;
    p.drag_coefficient = 1.0;
    p.drag = GENERATE(DragModel::projected, DragModel::panel);
    p.buoyancy = BuoyancyModel::distributed;
    World w = test::plate_world(p, Vec3(1, 1, 1), 0.1, 0.2, 100.0);
    const std::int32_t shape = test::add_shape(w, set);
    Dice dice{std::mt19937(9)};
    for (int n = 0; n < 13; ++n) {
        const Vec3 at(double(n), 0.0, 0.5 * dice.number());
        const std::size_t floe = add_floe(w.scene, shape, 900.0, at, turn(dice), 0, false);
        w.scene.bodies.velocity[floe] = dice.vector();
        w.scene.bodies.angular_velocity[floe] = dice.vector();
    }
    check_bits(w, w.scene.bodies.moving);
}
