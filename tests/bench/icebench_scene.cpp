// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/icebench_scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "preprocess/fill/fill_spheres.hpp"
#include "solver/scene/build_scene.hpp"
#include "tests/support/make_hull.hpp"
#include "tests/support/make_sphere_sets.hpp"
#include "tests/validation/paper_case.hpp"

namespace ice::bench {

namespace {

constexpr double kIceDensity = 900.0, kWaterDensity = 1000.0;  // [kg/m3]
constexpr double kWedgeStart = -9.6;  // x of its stern: the waterline ends just before the ice [m]
constexpr double kDraught = 8.0;      // of the 100 m hull [m]
constexpr double kForever = 1e9;      // [s]
constexpr int kFreeOfHeld = 500;      // floes that are not held in the scene "held"
constexpr double kHeldFrom = 50.0;    // x of its first held floe: 20 m ahead of those [m]

// Steele, Lea, Flood: Fast splittable pseudorandom number generators, OOPSLA 2014.
class SplitMix64 {
public:
    explicit SplitMix64(std::uint64_t seed) : state_(seed) {}
    /// Even over [0, 1): the upper 53 bits.
    double next() {
        state_ += 0x9e3779b97f4a7c15ull;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
        return std::ldexp(static_cast<double>((z ^ (z >> 31)) >> 11), -53);
    }

private:
    std::uint64_t state_;
};

Case field_case(const Models& models, double ship_speed) {
    Case p;
    p.duration = kForever;
    p.time_step = 0.01;
    p.water_density = kWaterDensity;
    p.ice_density = kIceDensity;
    p.speed_table = {{0.0, ship_speed}};
    p.floes.resize(1);
    p.floes[0].hold = Hold::never;
    p.contact.restitution = 0.3;
    p.contact.friction_ship_ice = 0.1;
    p.contact.friction_ice_ice = 0.3;
    p.drag_coefficient = 1.0;
    p.normal = models.normal;
    p.contact.iterations = models.iterations;
    p.buoyancy = models.buoyancy;
    p.drag = models.drag;
    if (models.buoyancy == BuoyancyModel::none) p.gravity = 0.0;  // or floes would fall
    return p;
}

World field_world(const Field& field, const SphereSet& hull, const Vec3& hull_position,
                  const SphereSet& floe, const Models& models) {
    World w;
    w.parameters = field_case(models, field.ship_speed);
    w.parameters.hull_position = hull_position;
    w.scene = make_scene(build_shape(hull, false), hull_position, Vec3(field.ship_speed, 0.0, 0.0));
    w.scene.shapes.push_back(build_shape(floe, true));
    for (const FloeStart& start : place_floes(field)) add_floe(w.scene, 1, kIceDensity, start, 0);
    return w;
}

// Adds floes of a field that are held until the ship comes, `ahead` [m] along x.
void add_held(World& w, const Field& field, double ahead) {
    w.parameters.floes.push_back(w.parameters.floes[0]);
    w.parameters.floes[1].hold = Hold::until_hull_contact;
    for (const FloeStart& start : place_floes(field))
        add_floe(w.scene, 1, kIceDensity,
                 {.position = start.position + Vec3(ahead, 0.0, 0.0),
                  .orientation = start.orientation,
                  .hold = Hold::until_hull_contact},
                 1);
}

// The squarest columns x rows of this many floes.
Field rectangle_of(int floes) {
    Field field;
    field.rows = static_cast<int>(std::sqrt(static_cast<double>(floes)));
    while (floes % field.rows != 0) --field.rows;
    field.columns = floes / field.rows;
    return field;
}

BenchScene wedge_scene(const std::string& name, const Field& field, const Models& models) {
    BenchScene out;
    out.name = name;
    out.hull = make_wedge_set();
    out.floe = make_floe_set(field.floe_size, 0.05);
    out.floe_size = field.floe_size;
    out.for_peers = true;
    out.world = field_world(field, out.hull, Vec3(kWedgeStart, 0.0, 0.0), out.floe, models);
    return out;
}

// x of the foremost point of the hull below this height above its keel [m].
double bow_below(const TriangleMesh& mesh, double height) {
    double x = -1e300;
    for (const Vec3& v : mesh.vertices)
        if (v.z() <= height) x = std::max(x, v.x());
    return x;
}

// A ship of 100 m goes through ice of 1 m at 2 m/s: the loose field five times as large.
BenchScene ship_scene(const std::string& name, int floes, const Models& models) {
    Field field = rectangle_of(floes);
    field.floe_size = Vec3(5.0, 4.0, 1.0);
    field.gap = 0.5;
    field.ship_speed = 2.0;
    FillOptions options;
    options.radius = 0.1;
    options.surface_only = true;
    SpheresReport report;
    const SphereSet hull = fill_spheres(test::make_hull({}, 100000), options, report);
    const SphereSet floe = make_floe_set(field.floe_size, 0.1);
    const double bow = bow_below(hull.mesh, kDraught + field.floe_size.z());
    BenchScene out;
    out.name = name;
    out.floe_size = field.floe_size;
    out.world = field_world(field, hull, Vec3(-bow, 0.0, -kDraught), floe, models);
    return out;
}

// What stands still beside a field that moves.
BenchScene held_scene(const std::string& name, int floes, const Models& models) {
    BenchScene out = wedge_scene(name, rectangle_of(kFreeOfHeld), models);
    out.for_peers = false;
    if (floes > kFreeOfHeld) add_held(out.world, rectangle_of(floes - kFreeOfHeld), kHeldFrom);
    return out;
}

}  // namespace

const std::vector<std::string>& scene_names() {
    static const std::vector<std::string> names{"loose", "packed", "held", "paper-3d", "ship-100m"};
    return names;
}

bool takes_any_number(const std::string& name) {
    return name == "loose" || name == "packed" || name == "held";
}

int fewest_floes(const std::string& name) { return name == "held" ? kFreeOfHeld : 1; }

std::vector<int> usual_floes(const std::string& name) {
    if (name == "paper-3d") return {180};
    if (name == "ship-100m") return {2000};
    if (name == "held") return {kFreeOfHeld, kFreeOfHeld + 100000};
    return {100, 400, 1600, 10000};
}

std::vector<FloeStart> place_floes(const Field& field) {
    SplitMix64 random(20240607);
    const double pitch_x = field.floe_size.x() + field.gap;
    const double pitch_y = field.floe_size.y() + field.gap;
    const double height = -(kIceDensity / kWaterDensity - 0.5) * field.floe_size.z();
    std::vector<FloeStart> out;
    for (int column = 0; column < field.columns; ++column)
        for (int row = 0; row < field.rows; ++row) {
            const double stagger = (column % 2 == 1 ? 0.25 : -0.25) * pitch_y;
            const double yaw = field.yaw * (2.0 * random.next() - 1.0);
            const double speed = field.drift * std::sqrt(random.next());
            const double heading = 2.0 * std::numbers::pi * random.next();
            out.push_back({Vec3((column + 0.5) * pitch_x,
                                (row + 0.5 - 0.5 * field.rows) * pitch_y + stagger, height),
                           Quaternion(std::cos(0.5 * yaw), 0.0, 0.0, std::sin(0.5 * yaw)),
                           Vec3(speed * std::cos(heading), speed * std::sin(heading), 0.0)});
        }
    return out;
}

SphereSet make_floe_set(const Vec3& size, double radius) {
    FillOptions options;
    options.radius = radius;
    options.arrangement = Arrangement::lattice;
    SpheresReport report;
    return fill_spheres(test::make_box_mesh(size), options, report);
}

BenchScene make_bench_scene(const std::string& name, int floes, const Models& models) {
    if (name == "ship-100m") return ship_scene(name, floes, models);
    if (name == "paper-3d") {
        BenchScene out;
        out.name = name;
        out.world = test::paper_3d();
        return out;
    }
    if (name == "held") return held_scene(name, floes, models);
    Field field = rectangle_of(floes);
    if (name == "packed") {  // a sheet sawn into floes, at rest
        field.gap = 0.004;
        field.yaw = field.drift = 0.0;
    }
    return wedge_scene(name, field, models);
}

}  // namespace ice::bench
