// SPDX-License-Identifier: GPL-3.0-or-later
/// The scenes that icebench measures: fields of equal floes and a ship that goes into them.
#pragma once

#include <string>
#include <vector>

#include "solver/scene/build_scene.hpp"
#include "solver/step/step.hpp"

namespace ice::bench {

/// How the solver treats the fields; the paper's case has its own models.
struct Models {
    BuoyancyModel buoyancy = BuoyancyModel::distributed;  ///< none: no weight either
    DragModel drag = DragModel::panel;
    NormalRule normal = NormalRule::surface;
    int iterations = 10;  ///< upper bound per stage of the contact solver
};

/// Equal box floes in columns along x and rows along y, and where the ship starts.
struct Field {
    int columns = 1, rows = 1;
    Vec3 floe_size{1.0, 0.8, 0.3};  ///< [m]
    double gap = 0.1;               ///< between neighbours along x and y [m]
    double yaw = 0.05;              ///< floes are turned by up to this [rad]
    double drift = 0.2;             ///< and move by up to this [m/s]
    double ship_speed = 0.5;        ///< [m/s]
};

/// One scene in the state it starts from, with the whole sphere sets of its two shapes.
struct BenchScene {
    std::string name;
    World world;
    SphereSet hull, floe;    ///< empty where no other engine takes the scene
    Vec3 floe_size;          ///< of the box [m]
    bool for_peers = false;  ///< other engines can be asked to do it, too
};

/// Names of the scenes: "loose", "packed", "held", "paper-3d", "ship-100m".
const std::vector<std::string>& scene_names();

/// Numbers of floes that a scene is measured with unless others are asked for. paper-3d and
/// ship-100m have one number and no other.
std::vector<int> usual_floes(const std::string& name);
bool takes_any_number(const std::string& name);
/// ... from this one on.
int fewest_floes(const std::string& name);

/// Makes a scene ready.
/// @param floes  loose and packed: any number >= 1, in the squarest whole rectangle; held: >= 500,
///               the first 500 a loose field, all others held ahead of it until the ship comes,
///               which takes longer than a minute
BenchScene make_bench_scene(const std::string& name, int floes, const Models& models);

/// Starts of a field's floes, column by column from x = 0 on: odd columns are a quarter of a pitch
/// to port, even ones as much to starboard, at floating height for 900 and 1000 kg/m3. Three
/// numbers a floe from the generator splitmix64 with the seed 20240607: yaw, speed and direction
/// of drift, the latter even over a disc.
std::vector<FloeStart> place_floes(const Field& field);

/// The box floe as a cubic lattice of touching spheres: 10 x 8 x 3 of 0.05 m for 1 x 0.8 x 0.3 m.
SphereSet make_floe_set(const Vec3& size, double radius);

/// The wedge hull: 10 x 2 x 1.8 m, stern at x = 0, the last 3 m taper from keel and sides to the
/// deck at x = 10 m, water at z = 0. 4557 spheres of 0.1 m cover sides, bottom and transom at a
/// spacing of 0.1 m from inside.
SphereSet make_wedge_set();

}  // namespace ice::bench
