// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/run/make_world.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/base/assert.hpp"
#include "common/base/error.hpp"
#include "solver/scene/build_scene.hpp"
#include "solver/scene/place_hull.hpp"
#include "solver/scene/set_breaking_loads.hpp"
#include "solver/water/hydrostatics.hpp"

namespace ice {

namespace {

void require_positive(const char* name, double value) {
    if (!(value > 0.0) || !std::isfinite(value))
        throw bad_input(fmt::format("Case::{}", name), fmt::format("is {}", value),
                        "give a positive number");
}

void require_rising_times(const Case& p) {
    for (std::size_t k = 1; k < p.speed_table.size(); ++k)
        if (!(p.speed_table[k].first > p.speed_table[k - 1].first))
            throw bad_input("Case::speed_table", fmt::format("row {}: time does not rise", k + 1),
                            "order the rows by time, each time once");
}

// A section and a solid have other units: one in the other's world would have a wrong mass.
void require_dimension(const SphereSet& set, int dimension, const char* what) {
    if (set.dimension != dimension)
        throw bad_input(
            what, fmt::format("is a {}D set in a world of {} dimensions", set.dimension, dimension),
            "fill hull and floes by the same function, and set Case::dimension");
}

// Row of the floes with this rule of release: a case has one group for each rule.
std::int32_t group_of(Case& parameters, Hold hold) {
    auto& groups = parameters.floes;
    const auto known = std::find_if(groups.begin(), groups.end(),
                                    [&](const FloeGroup& g) { return g.hold == hold; });
    const auto row = static_cast<std::int32_t>(known - groups.begin());
    if (known == groups.end()) {
        groups.emplace_back();
        groups.back().pattern = Pattern::single;
        groups.back().hold = hold;
    }
    return row;
}

}  // namespace

World make_world(const Case& parameters, const SphereSet& hull) {
    // A case file was checked by its reader; a program that fills a Case itself has the same checks
    // here.
    require_positive("time_step", parameters.time_step);
    require_positive("ice_density", parameters.ice_density);
    require_positive("water_density", parameters.water_density);
    require_rising_times(parameters);
    require_dimension(hull, parameters.dimension, "the hull");
    World world;
    world.parameters = parameters;
    // a world has no groups until add_floe makes them, one for each rule of release
    world.parameters.floes.clear();
    if (world.parameters.speed_table.empty()) world.parameters.speed_table = {{0.0, 0.0}};
    Shape shape = build_shape(hull, false);
    const Vec3 place = hull_place(parameters, shape.mesh);
    world.scene =
        make_scene(std::move(shape), place, Vec3(world.parameters.ship_speed(0.0), 0.0, 0.0));
    return world;
}

std::int32_t add_floe_shape(World& world, const SphereSet& floe) {
    require_dimension(floe, world.parameters.dimension, "the floe");
    world.scene.shapes.push_back(build_shape(floe, true));
    return static_cast<std::int32_t>(world.scene.shapes.size()) - 1;
}

std::size_t add_floe(World& world, std::int32_t shape, const FloeStart& start) {
    // the floe would be missing in existing neighbour lists and statistics
    ICE_ASSERT(world.steps == 0);
    Case& p = world.parameters;
    const auto& shapes = world.scene.shapes;
    if (shape < 1 || shape >= static_cast<std::int32_t>(shapes.size()))
        throw bad_input("add_floe", fmt::format("no shape has the number {}", shape),
                        "give a number that add_floe_shape() returned");
    FloeStart placed = start;
    // A quaternion of another length would scale the floe.
    placed.orientation = start.orientation.normalized();
    double& z = placed.position.z();
    // without z: afloat in the given attitude
    if (std::isnan(z)) {
        const double fraction = p.ice_density / p.water_density;
        if (fraction >= 1.0)
            throw bad_input("add_floe", "ice as dense as water has no floating equilibrium",
                            "give z, or lower Case::ice_density");
        z = floating_height(shapes[static_cast<std::size_t>(shape)],
                            placed.orientation.toRotationMatrix(), fraction);
    }
    if (start.hold == Hold::until_bent && p.contact.is_rigid())
        throw bad_input("add_floe",
                        "Hold::until_bent: the force on rigid ice that is held has no value",
                        "give a finite Case::contact.crushing_pressure");
    const std::size_t i =
        add_floe(world.scene, shape, p.ice_density, placed, group_of(p, start.hold));
    // for a floe that is held until it bends
    set_breaking_loads(world.scene, p);
    return i;
}

StepRecord measure_step(const World& world) {
    return measure_step(world.scene, world.contacts, world.constraints, world.parameters.time_step);
}

}  // namespace ice
