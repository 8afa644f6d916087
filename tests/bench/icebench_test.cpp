// SPDX-License-Identifier: GPL-3.0-or-later
// What icebench measures is the scene it says it is. Sums marked "independent" are those of a
// second program for the same scenes that shares no code with this one.
//
// Tolerances: 1e-12 and 1e-9 are rounding of sums over triangles and spheres.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "common/geometry/surface_tree.hpp"
#include "solver/record/measure_step.hpp"
#include "tests/bench/icebench_measure.hpp"
#include "tests/bench/icebench_peer.hpp"
#include "tests/support/tolerance.hpp"

using namespace ice;
using namespace ice::bench;
using ice::test::Near;
using ice::test::tolerance;

namespace {

// Rounding of sums of a few thousand numbers of the size of 10.
constexpr double kRounding = 1e-8;

struct Sums {
    double x = 0.0, y = 0.0, z = 0.0, drift_x = 0.0, drift_y = 0.0, turn = 0.0;
};

// All but x and z are weighted with the floe's number, so that the order counts.
Sums sums_of(const std::vector<FloeStart>& floes) {
    Sums s;
    for (std::size_t k = 0; k < floes.size(); ++k) {
        const double number = static_cast<double>(k + 1);
        s.x += floes[k].position.x();
        s.y += number * floes[k].position.y();
        s.z += floes[k].position.z();
        s.drift_x += number * floes[k].velocity.x();
        s.drift_y += number * floes[k].velocity.y();
        s.turn += number * floes[k].orientation.z();
    }
    return s;
}

// Integral over x of breadth times depth, both linear between the places where the bow's planes
// (the inner ones moved out by 0.1 m) begin: Simpson's rule is exact there.
double wedge_volume() {
    const double side = 9.0 + 0.1 * std::hypot(0.9, 3.0), ramp = 14.8 + 0.1 * std::hypot(1.6, 3.0);
    const auto section = [&](double x) {
        return 2.0 * std::min(1.0, (side - 0.9 * x) / 3.0) *
               (0.5 - std::max(-1.3, (1.6 * x - ramp) / 3.0));
    };
    const double ends[] = {0.0, (side - 3.0) / 0.9, (ramp - 3.9) / 1.6, 10.0};
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) {
        const double a = ends[k], b = ends[k + 1];
        sum += (b - a) / 6.0 * (section(a) + 4.0 * section(0.5 * (a + b)) + section(b));
    }
    return sum;
}

}  // namespace

TEST_CASE("the loose field of 1600 floes starts as the independent sums say", "[bench]") {
    Field field;
    field.columns = field.rows = 40;
    const Sums s = sums_of(place_floes(field));
    CHECK(std::abs(s.x - 35200.0) < tolerance(kRounding));
    CHECK(std::abs(s.y - 199080.0) < tolerance(kRounding));
    CHECK(std::abs(s.z - -192.0) < tolerance(kRounding));
    CHECK(std::abs(s.drift_x - -7385.7501744519186) < tolerance(kRounding));
    CHECK(std::abs(s.drift_y - 4387.0591416348225) < tolerance(kRounding));
    CHECK(std::abs(s.turn - 115.1866161603152) < tolerance(kRounding));
}

TEST_CASE("the packed field of 1600 floes is at rest with gaps of 4 mm", "[bench]") {
    const BenchScene scene = make_bench_scene("packed", 1600, {});
    const Bodies& b = scene.world.scene.bodies;
    REQUIRE(b.size() == 1601);
    double x = 0.0, y = 0.0;
    for (std::size_t i = 1; i < b.size(); ++i) {
        x += b.position[i].x();
        y += static_cast<double>(i) * b.position[i].y();
        CHECK(b.velocity[i].norm() == 0.0);
    }
    CHECK(std::abs(x - 32128.0) < tolerance(kRounding));   // independent
    CHECK(std::abs(y - 177844.8) < tolerance(kRounding));  // independent
    CHECK(b.position[2].y() - b.position[1].y() == Near(0.804));
}

TEST_CASE("a floe of 1 x 0.8 x 0.3 m is 240 spheres, 216 kg", "[bench]") {
    const BenchScene scene = make_bench_scene("loose", 4, {});
    CHECK(scene.floe.size() == 240);
    CHECK(scene.floe.surface_count == 240 - 8 * 6 * 1);
    double square = 0.0;
    for (const Vec3& c : scene.floe.centers) square += c.squaredNorm();
    CHECK(std::abs(square - 34.0) < tolerance(kRounding));  // independent
    CHECK(scene.world.scene.bodies.mass[1] == Near(216.0));
    const Vec3 inertia = scene.world.scene.bodies.inertia(1).diagonal();
    CHECK((inertia - Vec3(13.14, 19.62, 29.52)).norm() <
          tolerance(kRounding));  // m (l^2 + l^2) / 12
}

TEST_CASE("the wedge's 4557 spheres touch its solid from inside", "[bench]") {
    const SphereSet set = make_wedge_set();
    CHECK(set.size() == 4557);
    CHECK(set.surface_count == 4557);
    Vec3 sum = Vec3::Zero();
    for (const Vec3& c : set.centers) sum += Vec3(c.x(), std::abs(c.y()), c.z());
    // independent
    CHECK((sum - Vec3(18443.6, 3109.4516584984863, -2697.2533333333163)).norm() <
          tolerance(kRounding));
    const SurfaceTree tree(set.mesh);
    double worst = 0.0;
    for (const Vec3& c : set.centers) {
        const Foot foot = tree.closest(c);
        REQUIRE(foot.inside);
        worst = std::max(worst, std::abs(foot.distance - set.radius));
    }
    CHECK(worst < tolerance(1e-12));
    CHECK(set.solid.volume == Near(wedge_volume()).epsilon(1e-12));
    double area = 0.0;
    for (const double a : set.areas) area += a;
    CHECK(area == Near(set.solid.area).epsilon(1e-9));
    // in each of 99 frames bottom meets both sides
    CHECK(set.creases.size() >= 2 * 2 * 99);
}

TEST_CASE("no scene starts with an overlap", "[bench]") {
    const std::string name = GENERATE("loose", "packed", "held", "ship-100m");
    CAPTURE(name);
    BenchScene scene = make_bench_scene(name,
                                        name == "held"        ? 520
                                        : name == "ship-100m" ? 20
                                                              : 100,
                                        {});
    World& w = scene.world;
    step(w);
    CHECK(measure_step(w.scene, w.contacts, w.constraints, 0.01).max_overlap == 0.0);
}

TEST_CASE("in the scene held 500 floes move, and the others wait well ahead of them", "[bench]") {
    const BenchScene scene = make_bench_scene("held", 520, {});
    const Bodies& b = scene.world.scene.bodies;
    REQUIRE(b.size() == 521);
    CHECK(b.moving.size() == 500);
    double foremost = -1e300, nearest = 1e300;
    for (std::size_t i = 1; i < b.size(); ++i)
        (b.held[i] ? nearest = std::min(nearest, b.position[i].x())
                   : foremost = std::max(foremost, b.position[i].x()));
    CHECK(nearest > foremost + 20.0);
}

TEST_CASE("a floe moved by a nanometre changes the state's hash", "[bench]") {
    const BenchScene scene = make_bench_scene("packed", 4, {});
    BenchScene moved = scene;
    moved.world.scene.bodies.position[1].x() += 1e-9;
    const Watch on = [](double) { return true; };
    const Row a = measure_solver(scene, 3, on), b = measure_solver(scene, 3, on);
    CHECK(a.state_hash == b.state_hash);
    CHECK(a.state_hash != measure_solver(moved, 3, on).state_hash);
    CHECK(a.step_ms.size() == 3);
    CHECK(a.stage_ms.size() == kStageNames.size());
}

TEST_CASE("steps that a peer did not reach are left out of the ratio", "[bench]") {
    Row ours, peer;
    ours.step_ms = ours.step_cpu_ms = {1.0, 1.0, 100.0};
    peer.step_ms = peer.step_cpu_ms = {10.0, 30.0};
    CHECK(ratio(peer, ours) == Near(20.0));
    CHECK(ours.median_ms() == 1.0);
    CHECK(ours.least_ms() == 1.0);
    CHECK(ours.mean_ms() == Near(34.0));
}

TEST_CASE("the peers' water carries a floe at 9/10 of its thickness and slows it", "[bench]") {
    const Case p = make_bench_scene("loose", 1, {}).world.parameters;
    const BoxWater water(Vec3(1.0, 0.8, 0.3), p);
    const Mat3 level = Mat3::Identity();
    const Vec3 none = Vec3::Zero();
    CHECK(water.load(-0.12, level, none, none).force.norm() < tolerance(1e-9));
    CHECK(water.load(1.0, level, none, none).force.z() == Near(-216.0 * 9.81));
    // 1/2 rho C_d A u^2 with 0.9 of the face 0.8 x 0.3 m under water
    CHECK(water.load(-0.12, level, Vec3::UnitX(), none).force.x() == Near(-0.9 * 500.0 * 0.24));
    // independent: turned, moving and turning
    const Mat3 turned = Quaternion(std::sqrt(0.86), 0.1, 0.2, 0.3).toRotationMatrix();
    const WaterLoad load = water.load(-0.1, turned, Vec3(0.5, -0.4, 0.3), Vec3(0.7, -0.2, 0.4));
    CHECK((load.force - Vec3(-52.9969676154479, 29.3014233266554, -226.413966691411)).norm() <
          tolerance(kRounding));
    CHECK((load.moment - Vec3(-2.23509690084813, 1.25342886301449, -1.62411329785561)).norm() <
          tolerance(kRounding));
}

TEST_CASE("floes that touch nothing move alike in every peer", "[bench][peers]") {
    const BenchScene scene = make_bench_scene("loose", 9, {});
    for (const PeerKind& kind : peer_kinds()) {
        if (kind.make == nullptr) continue;
        CAPTURE(kind.name);
        const std::unique_ptr<Peer> peer = kind.make(scene);
        const double start = peer->kinetic_energy();
        // drift of every floe alone, along its axes: m du/dt = -1/2 rho C_d s A |u| u
        double expected = 0.0;
        const Bodies& b = scene.world.scene.bodies;
        for (std::size_t i = 1; i < b.size(); ++i)
            for (int d = 0; d < 2; ++d) {
                const double u = (b.rotation[i].transpose() * b.velocity[i])[d];
                const double rate = 0.9 * 500.0 * (d == 0 ? 0.24 : 0.3) / b.mass[i];
                const double end = u / (1.0 + rate * std::abs(u) * 0.1);
                expected += 0.5 * b.mass[i] * end * end;
            }
        for (int k = 0; k < 10; ++k) peer->step();
        CHECK(peer->contacts().count == 0);
        CHECK(expected < 0.99 * start);
        // explicit Euler leaves a share dt rate |u| of the loss, Bullet's floats less
        CHECK(peer->kinetic_energy() == Near(expected).epsilon(1e-3));
    }
}
