// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/soak/basin.hpp"

#include <cmath>

#include "preprocess/fill/fill_spheres.hpp"
#include "solver/scene/build_scene.hpp"
#include "tests/support/make_sphere_sets.hpp"

namespace ice::soak {

namespace {

constexpr double kLength = 29.5, kBreadth = 15.0;         // of the basin, from x = 0 [m]
constexpr double kWall = 1.0, kWallHeight = 4.0;          // thickness, half below the water [m]
constexpr double kShipLength = 10.0, kShipBreadth = 6.0;  // at the deck [m]
constexpr double kKeelLength = 6.0, kKeelBreadth = 1.0;   // [m]
constexpr double kDraught = 0.8, kFreeboard = 1.2;        // [m]
constexpr double kShipStart = 0.5;                        // x of its stern at t = 0 [m]
constexpr double kSpeed = 0.1, kTurn = 6.0;               // [m/s], half a turn [s]
const Vec3 kFloeSize(1.0, 0.8, kThickness);               // [m]
constexpr double kFloeRadius = 0.05;                      // of their spheres [m]
constexpr double kPitchX = 1.08, kPitchY = 0.88;          // of their places at t = 0 [m]

// A flared box: sloped ends and sides push floes down and let them slip out again. Keel at
// z = -kDraught, origin at the stern.
TriangleMesh ship_mesh() {
    TriangleMesh mesh = test::make_box_mesh({kShipLength, kShipBreadth, kDraught + kFreeboard});
    for (Vec3& v : mesh.vertices) {
        if (v.z() < 0.0) {
            v.x() *= kKeelLength / kShipLength;
            v.y() *= kKeelBreadth / kShipBreadth;
        }
        v += Vec3(0.5 * kShipLength, 0.0, 0.5 * (kFreeboard - kDraught));
    }
    return mesh;
}

SphereSet fill(const TriangleMesh& mesh, double radius, double spacing) {
    FillOptions options;
    options.radius = radius;
    options.spacing = spacing;
    options.surface_only = true;
    SpheresReport certificate;
    return fill_spheres(mesh, options, certificate);
}

// To and fro: [t, u] of one passage forwards and one back, repeated.
std::vector<std::pair<double, double>> shuttle(double duration) {
    std::vector<std::pair<double, double>> table;
    const double leg = 0.5 * kPeriod;
    for (double t = 0.0, u = kSpeed; t < duration; t += leg, u = -u) {
        table.emplace_back(t, 0.0);
        table.emplace_back(t + kTurn, u);
        table.emplace_back(t + leg - kTurn, u);
    }
    table.emplace_back(table.back().first + kTurn, 0.0);
    return table;
}

Case basin_case(double duration) {
    Case p;
    p.title = "Soak: a closed basin of 400 floes, stirred";
    p.duration = duration;
    p.time_step = 0.05;  // the ship goes 5 mm in it
    p.hull_position = Vec3(kShipStart, 0.0, 0.0);
    p.speed_table = shuttle(duration);
    p.floes.resize(2);
    p.floes[0].hold = Hold::never;
    p.floes[1].hold = Hold::always;  // walls
    p.contact.crushing_pressure = 1e6;
    p.frames_every = 10.0;
    p.history_every = 1.0;
    return p;
}

void add_walls(World& w) {
    const auto add = [&](const Vec3& size, double x, double y) {
        const SphereSet set = fill(test::make_box_mesh(size), 0.2, 0.4);
        w.scene.shapes.push_back(build_shape(set, true));
        add_floe(w.scene, static_cast<std::int32_t>(w.scene.shapes.size()) - 1,
                 w.parameters.ice_density, {.position = {x, y, 0.0}, .hold = Hold::always}, 1);
    };
    const double off = 0.5 * (kBreadth + kWall);
    add({kLength + 2.0 * kWall, kWall, kWallHeight}, 0.5 * kLength, off);
    add({kLength + 2.0 * kWall, kWall, kWallHeight}, 0.5 * kLength, -off);
    add({kWall, kBreadth, kWallHeight}, -0.5 * kWall, 0.0);
    add({kWall, kBreadth, kWallHeight}, kLength + 0.5 * kWall, 0.0);
}

// Columns along y of boxes in open order, without those at the ship.
void add_floes(World& w) {
    const SphereSet floe = fill(test::make_box_mesh(kFloeSize), kFloeRadius, 2.0 * kFloeRadius);
    w.scene.shapes.push_back(build_shape(floe, true));
    const double density = w.parameters.ice_density;
    const double height = -(density / w.parameters.water_density - 0.5) * kFloeSize.z();
    const double flare = kDraught / (kDraught + kFreeboard);  // the ship's at the waterline
    const double ship_breadth = std::lerp(kKeelBreadth, kShipBreadth, flare);
    const double ship_end =
        kShipStart + 0.5 * (kShipLength + std::lerp(kKeelLength, kShipLength, flare));
    const int rows = static_cast<int>(kBreadth / kPitchY);
    for (int i = 0; w.scene.bodies.size() <= kFloes; ++i)
        for (int j = 0; j < rows && w.scene.bodies.size() <= kFloes; ++j) {
            const Vec3 at((i + 0.5) * kPitchX, (j + 0.5 - 0.5 * rows) * kPitchY, height);
            if (at.x() > ship_end + 0.5 * kFloeSize.x() ||
                std::abs(at.y()) > 0.5 * (ship_breadth + kFloeSize.y()))
                add_floe(w.scene, 1, density, {.position = at}, 0);
        }
}

}  // namespace

World make_basin(double duration) {
    World w;
    w.parameters = basin_case(duration);
    const SphereSet ship = fill(ship_mesh(), 0.1, 0.2);
    w.scene = make_scene(build_shape(ship, false), w.parameters.hull_position, Vec3::Zero());
    add_floes(w);
    add_walls(w);
    return w;
}

int count_escaped(const World& world) {
    int count = 0;
    for (const std::int32_t i : world.scene.bodies.moving) {
        const Vec3& x = world.scene.bodies.position[static_cast<std::size_t>(i)];
        const bool inside = x.x() > 0.0 && x.x() < kLength && std::abs(x.y()) < 0.5 * kBreadth &&
                            std::abs(x.z()) < 10.0;
        count += !inside;  // also where it is no number
    }
    return count;
}

}  // namespace ice::soak
